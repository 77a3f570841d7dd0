# Report: The program stops in line 2:
name = input("Who are you? ")
