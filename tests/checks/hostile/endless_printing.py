# Report: More than 10 MB are printed. Is there a loop without an end?
while True:
    print("again and again and again and again and again and again " * 10)
