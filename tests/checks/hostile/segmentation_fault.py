# Report: The program ended before its functions could be checked.
import ctypes

ctypes.string_at(0)
