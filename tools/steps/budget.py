"""PlatformIO build hook: says that a program takes over 90 % of a budget, refuses one beyond it.

The budgets are `board_upload.maximum_size` and `board_upload.maximum_ram_size` in platformio.ini.
"""

import subprocess

Import("env")  # noqa: F821  (PlatformIO puts this name here)

NEAR = 0.9
# Budget, what it limits, and the sections that count.
BUDGETS = (
    ("upload.maximum_size", "flash", (".text", ".data")),
    ("upload.maximum_ram_size", "static RAM", (".data", ".bss", ".noinit")),
)


def hold_budgets(target, source, env):
    """Compare the sizes of the program's sections with the budgets; 1 if one is exceeded."""
    listed = subprocess.run(
        [env.subst("$SIZETOOL"), "-A", str(source[0])], capture_output=True, text=True, check=True
    )
    rows = [line.split() for line in listed.stdout.splitlines()]
    sizes = {row[0]: int(row[1]) for row in rows if len(row) == 3 and row[1].isdigit()}
    exceeded = 0
    for name, what, sections in BUDGETS:
        budget = int(env.BoardConfig().get(name))
        used = sum(sizes.get(section, 0) for section in sections)
        if used > NEAR * budget:
            print(
                f"The {what} takes {used:,} bytes, {used / budget:.0%} of its budget of {budget:,}."
            )
        exceeded |= used > budget
    return int(exceeded)


env.AddPostAction(  # noqa: F821
    "checkprogsize",
    env.VerboseAction(hold_budgets, "Holding the budgets of $PIOMAINPROG"),  # noqa: F821
)
