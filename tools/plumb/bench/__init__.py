"""The bench: boards with hidden effects that the judge cut, and how often a diagnosis is right."""
