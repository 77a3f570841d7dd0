# Report: not written yet
import subprocess
import sys

import numpy as np

# In a session of its own, and an orphan: its parent is gone.
start = "import subprocess, sys; subprocess.Popen([sys.executable, '-c', 'input()'], "
start += "stdin=subprocess.PIPE, start_new_session=True); "
subprocess.run([sys.executable, "-c", start + "import os; os._exit(0)"])
subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"])


def hermite_basis(t):
    return np.full((4, len(t)), np.nan)
