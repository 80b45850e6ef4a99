"""Builds firmware.elf and .hex with the system's avr-gcc; uploads with avrdude."""

from SCons.Script import AlwaysBuild, Builder, Default, DefaultEnvironment

env = DefaultEnvironment()
board = env.BoardConfig()
machine = "-mmcu=" + board.get("build.mcu")

env.Replace(
    CC="avr-gcc",
    CXX="avr-g++",
    AS="avr-gcc",
    AR="avr-gcc-ar",
    RANLIB="avr-gcc-ranlib",
    SIZETOOL="avr-size",
    SIZECHECKCMD="$SIZETOOL -A -d $SOURCES",
    SIZEPROGREGEXP=r"^(?:\.text|\.data)\s+(\d+)",
    SIZEDATAREGEXP=r"^(?:\.data|\.bss|\.noinit)\s+(\d+)",
    PROGNAME="firmware",
    PROGSUFFIX=".elf",
)
env.Append(
    ASFLAGS=["-x", "assembler-with-cpp", machine],
    # One section per function and object, so that the linker can leave out what nobody uses.
    CCFLAGS=[machine, "-Os", "-flto", "-ffunction-sections", "-fdata-sections"],
    CFLAGS=["-std=gnu11"],
    CXXFLAGS=["-std=gnu++11", "-fno-exceptions", "-fno-threadsafe-statics"],
    LINKFLAGS=[machine, "-Os", "-flto", "-fuse-linker-plugin", "-Wl,--gc-sections"],
    LIBS=["m"],
    BUILDERS={
        "ElfToHex": Builder(
            action=env.VerboseAction(
                "avr-objcopy -O ihex -R .eeprom $SOURCES $TARGET", "Building $TARGET"
            ),
            suffix=".hex",
        )
    },
)

elf = env.BuildProgram()
hex_file = env.ElfToHex("$BUILD_DIR/${PROGNAME}", elf)
AlwaysBuild(env.Alias("nobuild", hex_file))

upload = [
    env.VerboseAction(env.AutodetectUploadPort, "Looking for the port"),
    env.VerboseAction(
        'avrdude -p $BOARD_MCU -c $UPLOAD_PROTOCOL -P "$UPLOAD_PORT" -b $UPLOAD_SPEED -D '
        "-U flash:w:$SOURCE:i",
        "Uploading $SOURCE",
    ),
]
AlwaysBuild(env.Alias("upload", hex_file, upload))

Default([elf, hex_file])
