# Report: did not end within 2 seconds. | has nothing called SIGSTOP
import os
import signal

os.kill(os.getpid(), signal.SIGSTOP)
