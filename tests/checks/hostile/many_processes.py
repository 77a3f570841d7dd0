# Report: The program started more than 64 programs. | did not end
import os
import subprocess
import sys
import time

if hasattr(os, "fork"):
    for _ in range(100):
        if os.fork() == 0:
            time.sleep(60)
            os._exit(0)
else:
    for _ in range(100):
        subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
time.sleep(60)
