"""The published controllers and ours, by the names that files and options use."""

CONTROLLERS = ("stock", "holey", "plumb")  # whose formulas paid the chains out
CLIENTS = ("groundcontrol", "webcontrol", "none")  # what sends G-code; none keeps no numbers
FIRMWARES = ("plumb", "published")  # what the machine runs
