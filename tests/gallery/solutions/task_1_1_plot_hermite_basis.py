import numpy as np


def hermite_basis(t):
    """Return the four curves as rows: H[0] is H0, and so on."""
    H = np.full((4, len(t)), np.nan)
    H[0] = 2 * t**3 - 3 * t**2 + 1  # start value: given
    H[1] = -2 * t**3 + 3 * t**2
    H[2] = t**3 - 2 * t**2 + t
    H[3] = t**3 - t**2
    return H
