"""The settings of a machine, and the files that hold them."""
