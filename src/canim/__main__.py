"""`python -m canim` is the command `canim`, also where the terminal does not find that."""

import sys

from canim.cli import main

sys.exit(main())
