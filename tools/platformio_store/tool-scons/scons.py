"""Starts the SCons that is installed beside PlatformIO."""

from SCons.Script import main

main()
