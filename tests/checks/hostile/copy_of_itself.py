# Report: not written yet
import os

import numpy as np

if hasattr(os, "fork"):
    os.fork()


def hermite_basis(t):
    return np.full((4, len(t)), np.nan)
