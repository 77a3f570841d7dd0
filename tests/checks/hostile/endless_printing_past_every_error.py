# Report: The program did not end within 2 seconds.
from contextlib import suppress

while True:
    with suppress(BaseException):
        print("again and again and again and again and again and again " * 10)
