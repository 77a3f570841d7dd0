# Report: The program took more than 400 MB of memory. | The program stops
import subprocess
import sys
import time

piece = "pieces = [b'x' * 2**20 for _ in range(150)]; import time; time.sleep(60)"
for _ in range(6):
    subprocess.Popen([sys.executable, "-c", piece])
time.sleep(60)
