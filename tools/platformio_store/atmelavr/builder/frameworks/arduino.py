"""Arduino's core and the board's variant as one library, from Debian's arduino-core-avr."""

from pathlib import Path

from SCons.Script import DefaultEnvironment

env = DefaultEnvironment()
board = env.BoardConfig()
arduino = Path("/usr/share/arduino/hardware/arduino/avr")
core = arduino / "cores" / board.get("build.core")
variant = arduino / "variants" / board.get("build.variant")

env.Append(
    CPPDEFINES=[
        ("F_CPU", "$BOARD_F_CPU"),
        ("ARDUINO", 10819),
        "ARDUINO_ARCH_AVR",
        "ARDUINO_AVR_MEGA2560",
        # The core prints numbers with a macro that avr-gcc 5.4 knows only by its inner name.
        ("DECIMAL_DIG", "__DECIMAL_DIG__"),
    ],
    # Not as system folders: avr-gcc takes what it finds there for C.
    CPPPATH=[str(core), str(variant)],
    LIBSOURCE_DIRS=[str(arduino / "libraries")],
)

quiet = env.Clone()
quiet.Append(CCFLAGS=["-w"])
env.Prepend(LIBS=[quiet.BuildLibrary("$BUILD_DIR/FrameworkArduino", str(core))])
