"""The virtual machine for people and tests: a garage with a machine, a tape, and a serial port."""
