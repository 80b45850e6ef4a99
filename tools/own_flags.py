"""PlatformIO build hook: `custom_own_flags` for our own files, not for borrowed ones.

With PLUMB_WARNINGS=error a warning stops the build; the test run sets it.
"""

import os
from pathlib import Path

Import("env")  # noqa: F821  (PlatformIO puts this name here)

ROOT = Path(env.subst("$PROJECT_DIR")).resolve()  # noqa: F821
OWN = tuple(ROOT / folder for folder in ("src", "lib", "include", "test"))
FLAGS = env.GetProjectOption("custom_own_flags", "").split()  # noqa: F821
if os.environ.get("PLUMB_WARNINGS") == "error" and "-Werror" not in FLAGS:
    FLAGS.append("-Werror")


def warn_about_own_files(build_env, node):
    """The object of one source file, with our warnings when the file is ours."""
    source = Path(node.srcnode().get_abspath())
    if source.suffix != ".cpp" or not any(folder in source.parents for folder in OWN):
        return node
    return build_env.Object(node, CCFLAGS=[*build_env["CCFLAGS"], *FLAGS])


env.AddBuildMiddleware(warn_about_own_files)  # noqa: F821
