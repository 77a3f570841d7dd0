import numpy as np

M = np.array(
    [
        [2, -2, 1, 1],  # row for a: given
        [-3, 3, -2, -1],
        [0, 0, 1, 0],
        [1, 0, 0, 0],
    ]
)


def hermite_coefficients(f0, f1, d0, d1):
    """Return the four numbers a, b, c, d of the cubic."""
    wishes = np.array([f0, f1, d0, d1])
    coefficients = M @ wishes
    return coefficients


def hermite_curve(t, f0, f1, d0, d1):
    """Return the height of the curve at every value of t."""
    a, b, c, d = hermite_coefficients(f0, f1, d0, d1)
    curve = a * t**3 + b * t**2 + c * t + d
    return curve
