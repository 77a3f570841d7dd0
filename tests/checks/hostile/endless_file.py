# Report: The program stops in line 4:
with open("large.txt", "w") as file:
    for _ in range(300):
        file.write("0123456789" * 10**5)
