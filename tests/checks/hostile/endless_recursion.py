# Report: hermite_basis
import sys

sys.setrecursionlimit(10**9)


def hermite_basis(t):
    return hermite_basis(t + 1)
