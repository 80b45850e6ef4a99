"""Measurements on a sheet, and the files that hold them."""
