"""The platform "AVR board" as PlatformIO sees it; the compiler is the system's."""

from platformio.public import PlatformBase


class AtmelavrPlatform(PlatformBase):
    """A board to upload to, with nothing to fetch."""

    def is_embedded(self):
        return True
