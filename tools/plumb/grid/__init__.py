"""The G-code for calibration marks; this room needs only the standard library of Python 3.9."""
