"""What each command understands, and its help; loaded without numpy, so that help comes at once."""
