"""The platform "this computer" as PlatformIO sees it."""

from platformio.public import PlatformBase


class NativePlatform(PlatformBase):
    """Nothing to upload, nothing to fetch."""

    def is_embedded(self):
        return False
