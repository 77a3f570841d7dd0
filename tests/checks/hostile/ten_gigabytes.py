# Report: The program stops in line 4: | took more than 400 MB of memory.
import numpy as np

everything = np.ones(10 * 2**30, dtype=np.uint8)
