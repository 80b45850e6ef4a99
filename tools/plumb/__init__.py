"""The calibration lab of the Maslow hanging CNC: read, compare, diagnose, add, send."""
