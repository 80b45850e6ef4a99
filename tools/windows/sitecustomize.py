"""What Wine 8 does otherwise than Windows, mended for pyserial."""

import ctypes

# It lacks a function that pyserial looks up when it begins, and asks only of broken ports.
LACKING, THERE = "CM_MapCrToWin32Err", "CM_Get_Parent"
# A read that ends by its timeout has failed; on Windows it has read what came.
WAITED, TIMED_OUT = "GetOverlappedResult", 1460
looked_up = ctypes.CDLL.__getattr__


def found(library, name):
    function = looked_up(library, THERE if name == LACKING else name)
    if name == WAITED:
        function.errcheck = lambda result, *_: result or ctypes.GetLastError() == TIMED_OUT
    return function


ctypes.CDLL.__getattr__ = found
