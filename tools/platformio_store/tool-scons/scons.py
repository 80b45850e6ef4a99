"""Starts the SCons that is installed with PlatformIO."""

from SCons.Script import main

main()
