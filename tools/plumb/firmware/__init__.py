"""Settings of the flashed program by number, and its telemetry."""
