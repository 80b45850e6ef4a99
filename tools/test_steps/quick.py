"""The short run: which suites, rooms and checks an edited file asks for."""

import subprocess
from dataclasses import dataclass, field
from fnmatch import fnmatch
from pathlib import Path

from part import ROOT, Part, checks, firmware, host_tests, python_tests, setup

QUICK_CHECKS = (
    "arrows",
    "effects",
    "unused",
    "names",
    "formatting",
)
SLOW_CHECKS = ("annotations", "generated")
ROOMS = "tools/tests"
PROJECT = f"{ROOMS}/project"

# The first row that fits decides: a pattern, the suites of test/, and what pytest runs.
ROWS: tuple[tuple[str, tuple[str, ...], tuple[str, ...]], ...] = (
    ("lib/Kinematics/*", ("test_kinematics", "test_effects"), (f"{ROOMS}/model",)),
    ("lib/GCode/*", ("test_gcode", "test_dialogues"), ()),
    ("lib/Motion/*", ("test_motion", "test_control"), ()),
    ("lib/Settings/*", ("test_settings",), ()),
    ("src/board/*", ("test_board",), ()),
    ("src/*", ("test_machine", "test_dialogues"), (f"{ROOMS}/settings",)),
    ("test/dialogues/*", ("test_dialogues",), ()),
    ("test/programs/*", ("test_dialogues",), (f"{ROOMS}/job",)),
    ("test/vm/*", (), (f"{ROOMS}/firmware",)),
    ("tools/judge/*", ("test_reference",), ()),
    ("tools/vm/*", ("test_control", "test_dialogues"), (f"{ROOMS}/firmware", f"{ROOMS}/vm")),
    (
        "tools/checks/*",
        (),
        (f"{PROJECT}/test_project_checks.py",),
    ),
    ("tools/setup*", (), (f"{PROJECT}/test_setup.py",)),
    ("tools/test", (), (f"{PROJECT}/test_test_run.py",)),
    ("tools/test_steps/*", (), (f"{PROJECT}/test_test_run.py", f"{PROJECT}/test_counts.py")),
    ("tools/bench/*", (), (f"{PROJECT}/test_bench.py",)),
    ("tools/dry_run/*", (), (f"{ROOMS}/job",)),
    ("tools/core/*", (), (f"{PROJECT}/test_core_types.py", f"{ROOMS}/model")),
    ("tools/*", (), (PROJECT,)),
    ("*.md", (), (f"{PROJECT}/test_docs.py", f"{PROJECT}/test_recipes.py")),
    ("docs/*", (), (f"{PROJECT}/test_docs.py", f"{PROJECT}/test_recipes.py")),
)
FIRMWARE = ("lib/*", "src/*", "include/*", "platformio.ini")
ANNOTATED = ("tools/plumb/*", "tools/mypy.ini")
GENERATED = ("tools/plumb/*", "docs/*", "lib/Kinematics/*", "src/settings_table.h")


@dataclass
class Touched:
    """What the edited files ask for."""

    suites: set[str] = field(default_factory=set)
    rooms: set[str] = field(default_factory=set)
    checks: list[str] = field(default_factory=lambda: list(QUICK_CHECKS))
    builds_firmware: bool = False

    def add(self, file: str) -> None:
        """Add what a file asks for; its name is from the project's root."""
        self.builds_firmware |= _fits(file, FIRMWARE)
        for check, patterns in (("annotations", ANNOTATED), ("generated", GENERATED)):
            if _fits(file, patterns) and check not in self.checks:
                self.checks.append(check)
        suites, rooms = _asked(file)
        self.suites.update(suites)
        self.rooms.update(room for room in rooms if (ROOT / room).exists())

    def parts(self) -> tuple[list[Part], list[list[Part]]]:
        """Return what comes first, and then the lanes that run side by side."""
        cxx = [firmware()] if self.builds_firmware else []
        cxx += [host_tests(sorted(self.suites))] if self.suites else []
        python = [setup(), python_tests(sorted(self.rooms))] if self.rooms else []
        return [], [[checks(self.checks)], cxx + python]

    def left_out(self) -> str:
        """Return what a whole run does that this run does not."""
        skipped = ["fuzz", "bench"] + [
            f"check {name}" for name in SLOW_CHECKS if name not in self.checks
        ]
        done = [*sorted(self.suites), *sorted(self.rooms)]
        return f"Left out: {', '.join(skipped)}, and every suite but: {' '.join(done) or 'none'}"


def _asked(file: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    parts = Path(file).parts
    if parts[:2] == ("tools", "tests") and len(parts) > 3:
        # An edited test alone asks for itself.
        alone = parts[-1].startswith("test_") and file.endswith(".py")
        return (), (file if alone else "/".join(parts[:3]),)
    if parts[:2] == ("tools", "plumb") and len(parts) > 3:
        return (), (f"{ROOMS}/{parts[2]}",)
    if parts[0] == "test" and parts[1].startswith("test_") and len(parts) > 2:
        return (parts[1],), ()
    return next(
        ((suites, rooms) for pattern, suites, rooms in ROWS if fnmatch(file, pattern)), ((), ())
    )


def _fits(file: str, patterns: tuple[str, ...]) -> bool:
    return any(fnmatch(file, pattern) for pattern in patterns)


def edited() -> list[str]:
    """Files that differ from the last commit, and new files."""
    differ = ["git", "diff", "--name-only", "--diff-filter=d", "HEAD"]
    new = ["git", "ls-files", "--others", "--exclude-standard"]
    said = subprocess.check_output(differ, cwd=ROOT, text=True)
    said += subprocess.check_output(new, cwd=ROOT, text=True)
    return said.splitlines()


def touched() -> Touched:
    """Return what the files ask for that differ from the last commit."""
    asked = Touched()
    for file in edited():
        asked.add(file)
    return asked
