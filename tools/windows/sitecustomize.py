"""Wine 8 lacks a function that pyserial looks up when it begins, and asks only of broken ports."""

import ctypes

LACKING, THERE = "CM_MapCrToWin32Err", "CM_Get_Parent"
looked_up = ctypes.CDLL.__getattr__
ctypes.CDLL.__getattr__ = lambda library, name: looked_up(
    library, THERE if name == LACKING else name
)
