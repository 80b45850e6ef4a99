"""The diary of a machine: each fit, each change of its numbers and each recheck, in plain lines."""
