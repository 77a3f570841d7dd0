# Report: The program stops | did not end within
import tkinter

window = tkinter.Tk()
window.mainloop()


def hermite_basis(t):
    return t
