"""The settings of one machine, and the files that hold them."""
