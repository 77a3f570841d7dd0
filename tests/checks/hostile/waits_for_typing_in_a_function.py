# Report: hermite_basis stops in line 3:
def hermite_basis(t):
    return float(input("H0? "))
