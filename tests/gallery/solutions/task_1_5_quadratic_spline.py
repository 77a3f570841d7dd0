import numpy as np


def quadratic_spline_system(x, y, start):
    """Return A and b: one row of A and one number of b per equation."""
    pieces = len(x) - 1
    A = np.zeros((3 * pieces, 3 * pieces))
    b = np.full(3 * pieces, np.nan)
    for i in range(pieces):
        A[2 * i, 3 * i : 3 * i + 3] = [x[i] ** 2, x[i], 1]  # piece i begins: given
        b[2 * i] = y[i]
        A[2 * i + 1, 3 * i : 3 * i + 3] = [x[i + 1] ** 2, x[i + 1], 1]
        b[2 * i + 1] = y[i + 1]
    for i in range(pieces - 1):
        row = 2 * pieces + i
        A[row, 3 * i : 3 * i + 2] = [2 * x[i + 1], 1]
        A[row, 3 * i + 3 : 3 * i + 5] = [-2 * x[i + 1], -1]
        b[row] = 0
    if start == "straight":
        A[-1, 0] = 1
    else:
        A[-1, 0] = 2 * x[0]
        A[-1, 1] = 1
    b[-1] = 0
    return A, b
