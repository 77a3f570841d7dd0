# Report: H1, end value at t = 0.2: expected 0.104, got 0.2
import numpy as np

np.set_printoptions(precision=0, threshold=1, formatter={"all": lambda value: "?"})
np.seterr(all="raise")


def hermite_basis(t):
    return np.array([3 * t**3 - 3 * t**2 + 1 - t**3 - t / 25, t, t, t])
