"""The answers of an owner without mistakes on a machine's first day."""

# By a piece of the question, or by its kind; the first that fits answers.
OWNER = {"motor winds": "y", "Z motor raises": "y", "What did you see": "s", "router go up": "s"}
OWNER |= {"How does the sled hang": "r", "end of a chain": "139.1", "left motor's shaft": "2980"}
OWNER |= {"may that be wrong": "4", "top edge up": "464.5", "Weight of the sled": "10", "turn": "0"}
OWNER |= {"Lay each chain": "y", "pays out": "y", "Hang the sled": "y", "Switch the router on": "y"}
OWNER |= {"left edge to the mark": "1221", "top edge to the mark": "611"}
