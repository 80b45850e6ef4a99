"""The model of the machine: places, chains, tensions, reach, and the catalogue of effects."""
