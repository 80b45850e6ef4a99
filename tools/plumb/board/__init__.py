"""A measured board as the fit sees it: each reading, and where the sled went for it."""
