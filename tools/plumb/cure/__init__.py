"""Adding an effect to a machine, and what the error is then."""
