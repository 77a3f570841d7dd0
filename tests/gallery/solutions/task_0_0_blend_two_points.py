import numpy as np


def blend(a, b, t):
    """Return x and y of the point between a and b, for every moment in t."""
    x = (1 - t) * a[0] + t * b[0]
    y = (1 - t) * a[1] + t * b[1]
    return x, y
