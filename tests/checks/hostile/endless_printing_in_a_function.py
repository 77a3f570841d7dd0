# Report: hermite_basis stops in line 4: | More than 10 MB are printed.
def hermite_basis(t):
    while True:
        print("again and again and again and again and again and again " * 10)
