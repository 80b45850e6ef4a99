"""Fitting the model to a board, and comparing the two."""
