"""The first day of a machine, step by step: wires, numbers, reach, chains, the first mark.

Nothing moves without a yes to a sentence that names what will move and how far.
"""
