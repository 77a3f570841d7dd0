# Report: The program ended before its functions could be checked.
import os
import time

if hasattr(os, "fork") and os.fork() == 0:
    time.sleep(60)
os._exit(0)
