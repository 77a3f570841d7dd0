# Report: The program stops in line 4: | took more than 400 MB of memory.
pieces = []
while len(pieces) < 10_000:
    pieces.append(b"x" * 2**20)
