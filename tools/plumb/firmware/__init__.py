"""What the flashed program keeps and says: its settings by number, and its telemetry."""
