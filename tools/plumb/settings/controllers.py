"""The published controllers and ours, by the names that files and options use."""

CONTROLLERS = ("stock", "holey", "plumb")  # whose formulas paid the chains out
