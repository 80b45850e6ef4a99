"""The line to a machine: what goes over it, and how the machine answers."""
