# Report: not written yet
import matplotlib

matplotlib.use("TkAgg")
import matplotlib.pyplot as plt
import numpy as np

plt.switch_backend("TkAgg")
plt.ion()
plt.figure()
plt.plot([1, 2])
plt.pause(1000)
plt.waitforbuttonpress()
plt.ginput(timeout=0)
plt.show(block=True)


def hermite_basis(t):
    return np.full((4, len(t)), np.nan)
