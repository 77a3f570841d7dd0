# Report: not written yet
import threading

import numpy as np


def work():
    while True:
        pass


threading.Thread(target=work).start()


def hermite_basis(t):
    return np.full((4, len(t)), np.nan)
