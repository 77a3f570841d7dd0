# Report: hermite_basis returns more than the memory can hold.
import numpy as np


def hermite_basis(t):
    return np.broadcast_to(0.0, (100_000, 100_000)) if len(t) else None
