"""Jobs: programs of G-code, as the firmware would do them, before and after a halt."""
