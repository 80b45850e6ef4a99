"""PlatformIO build hook: flags for our files, and GoogleTest compiled ahead for all tests.

`custom_own_flags` are for our files, not for borrowed files. With PLUMB_WARNINGS=error a warning
stops the build; the test run sets it.

Most of the time of a test's file goes to GoogleTest's header, so a build for the host compiles that
first, and the compiler reads the result instead (`-include`).
"""

import hashlib
import os
from pathlib import Path

Import("env")  # noqa: F821  (PlatformIO puts this name here)

ROOT = Path(env.subst("$PROJECT_DIR")).resolve()  # noqa: F821
OWN = tuple(ROOT / folder for folder in ("src", "lib", "include", "test", "tools/judge"))
FLAGS = env.GetProjectOption("custom_own_flags", "").split()  # noqa: F821
if os.environ.get("PLUMB_WARNINGS") == "error" and "-Werror" not in FLAGS:
    FLAGS.append("-Werror")
HEADER = "gtest/gtest.h"
ASKED = "custom_precompiled"  # the option of an environment whose tests read HEADER precompiled
# What ccache must overlook, or it keeps nothing that was compiled with a precompiled header.
OVERLOOKED = "pch_defines,time_macros,include_file_mtime,include_file_ctime"
precompiled = []  # the header as the compiler keeps it


def with_own_flags(build_env, node):
    """The object of one source file, with our flags when the file is ours."""
    source = Path(node.srcnode().get_abspath())
    if source.suffix != ".cpp" or not any(folder in source.parents for folder in OWN):
        return node
    flags = [*build_env["CCFLAGS"], *FLAGS]
    if ROOT / "test" not in source.parents or not env.GetProjectOption(ASKED, ""):  # noqa: F821
        return build_env.Object(node, CCFLAGS=flags)
    header = build_env.subst("$BUILD_DIR/precompiled/") + Path(HEADER).name
    if not precompiled:
        precompiled.extend(precompile(build_env, Path(header)))
    # ccache asks for the last flag.
    built = build_env.Object(node, CCFLAGS=[*flags, "-include", header, "-fpch-preprocess"])
    build_env.Depends(built, precompiled)
    return built


def precompile(build_env, path):
    """Builds what the compiler reads instead of a header at this path."""
    text = f"#include <{HEADER}>\n"
    path.parent.mkdir(parents=True, exist_ok=True)
    put(path, text)
    command = "$CXX -o $TARGET -x c++-header -c $CXXFLAGS $CCFLAGS $_CCCOMCOM $SOURCE"
    built = build_env.Command(f"{path}.gch", str(path), command)
    library = Path(build_env.subst("$PROJECT_LIBDEPS_DIR/$PIOENV/googletest"))
    build_env.Depends(built, [str(header) for header in library.rglob("*.h")])
    # ccache reads this in place of the result, which is not the same bytes twice.
    what = build_env.subst("$CXXFLAGS $CCFLAGS") + text
    put(Path(f"{path}.gch.sum"), hashlib.sha256(what.encode()).hexdigest())
    build_env["ENV"]["CCACHE_SLOPPINESS"] = OVERLOOKED
    build_env["ENV"]["CCACHE_PCH_EXTSUM"] = "1"
    return built


def put(path, text):
    """Writes a file, unless it holds the text already."""
    if not path.is_file() or path.read_text() != text:
        path.write_text(text)


env.AddBuildMiddleware(with_own_flags)  # noqa: F821
