"""PlatformIO build hook: flags for our files, and a folder's files compiled together on the host.

`custom_own_flags` are for our files, not for borrowed files. With PLUMB_WARNINGS=error a warning
stops the build; the test run sets it.

Most of the time of a test's file goes to the headers that all of them read: GoogleTest's and the
laws'. With `custom_together = N` the compiler reads them once for N files of a folder.
"""

import os
from pathlib import Path

Import("env")  # noqa: F821  (PlatformIO puts this name here)

ROOT = Path(env.subst("$PROJECT_DIR")).resolve()  # noqa: F821
OWN = tuple(ROOT / folder for folder in ("src", "lib", "include", "test", "tools/judge"))
FLAGS = env.GetProjectOption("custom_own_flags", "").split()  # noqa: F821
if os.environ.get("PLUMB_WARNINGS") == "error" and "-Werror" not in FLAGS:
    FLAGS.append("-Werror")
TOGETHER = int(env.GetProjectOption("custom_together", "1"))  # noqa: F821
# GCC takes an included .cpp for a header, whose nameless namespace would be a mistake.
JOINED_FLAGS = ["-Wno-subobject-linkage"]
LIBRARIES = ROOT / "lib"  # PlatformIO compiles these by itself


def with_own_flags(build_env, node):
    """Return the object of a source file, with our flags when the file is ours.

    None for a file that is compiled with the first of its group.
    """
    source = Path(node.srcnode().get_abspath())
    if source.suffix != ".cpp" or not any(folder in source.parents for folder in OWN):
        return node
    flags = [*build_env["CCFLAGS"], *FLAGS]
    if TOGETHER == 1 or LIBRARIES in source.parents:
        return build_env.Object(node, CCFLAGS=flags)
    files = sorted(source.parent.glob("*.cpp"))
    place = files.index(source)
    if place % TOGETHER:
        return None
    joined = joined_file(build_env, files[place : place + TOGETHER])
    path = [*build_env["CPPPATH"], str(ROOT)]
    return build_env.Object(str(joined), CCFLAGS=[*flags, *JOINED_FLAGS], CPPPATH=path)


def joined_file(build_env, files):
    """Return a file that includes these, by their names below the project."""
    names = [file.relative_to(ROOT).as_posix() for file in files]
    folder = Path(build_env.subst("$BUILD_DIR")) / "joined"
    joined = folder / names[0].replace("/", "-")
    text = "".join(f'#include "{name}"\n' for name in names)
    folder.mkdir(parents=True, exist_ok=True)
    if not joined.is_file() or joined.read_text() != text:
        joined.write_text(text)
    return joined


env.AddBuildMiddleware(with_own_flags)  # noqa: F821
