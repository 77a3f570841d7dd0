def bernstein_basis(n, t):
    """Return n + 1 curves as rows: B[0] is the first, B[n] the last."""
    B = np.full((n + 1, len(t)), np.nan)
    B[0] = (1 - t) ** n  # first curve: given
    for i in range(1, n + 1):
        powers = t**i * (1 - t) ** (n - i)
        B[i] = comb(n, i) * powers
    return B
