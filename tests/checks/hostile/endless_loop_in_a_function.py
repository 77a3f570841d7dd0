# Report: did not end within 2 seconds. Is there a loop without an end?
def hermite_basis(t):
    while True:
        pass
