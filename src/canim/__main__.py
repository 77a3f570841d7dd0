"""`python -m canim` is the command `canim`, also where the terminal does not find that."""

import os
import sys

# Python looks into this folder first: a random.py of the class would run in the check itself.
sys.path[:] = [place for place in sys.path if place != os.getcwd()]
from canim.cli import main  # noqa: E402

sys.exit(main())
