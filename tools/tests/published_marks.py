"""Nine marks of a real machine and the settings they go with, as the lab carries them."""

from pathlib import Path

import plumb

FOLDER = Path(plumb.__file__).parent / "examples" / "mibproj"
SETTINGS = FOLDER / "groundcontrol.ini"
MARKS = FOLDER / "Calibration Measurements.ini"
