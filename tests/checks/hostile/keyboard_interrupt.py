# Report: The program stops in line 2:
raise KeyboardInterrupt
