# Report: The program did not end within 2 seconds.
import signal
import time
from contextlib import suppress

for number in (signal.SIGTERM, signal.SIGINT):
    signal.signal(number, signal.SIG_IGN)
while True:
    with suppress(BaseException):
        time.sleep(1000)
