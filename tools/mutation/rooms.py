"""The rooms that are mutated, and the tests that judge them, the nearest first."""

from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import cxx
import python

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / ".build/mutation"


@dataclass(frozen=True)
class Room:
    """A folder, its language, and the suites or files of tests that judge it."""

    name: str
    language: ModuleType
    tests: tuple[str, ...]
    commands: tuple[str, ...] = ()  # of the command line, which say what the room does

    def files(self) -> list[Path]:
        """Its sources, from the root."""
        endings = (".py",) if self.language is python else (".h", ".cpp")
        files = [path for path in (ROOT / self.name).rglob("*") if path.suffix in endings]
        files += [ROOT / f"tools/plumb/cli/{command}.py" for command in self.commands]
        return sorted(path.relative_to(ROOT) for path in files)


def in_cxx(name: str, *suites: str) -> Room:
    """A folder of C++."""
    return Room(name, cxx, suites)


def in_python(name: str, *tests: str, commands: tuple[str, ...] = ()) -> Room:
    """A folder of Python."""
    return Room(name, python, tuple(f"tools/tests/{test}" for test in tests), commands)


ROOMS = (
    in_cxx("lib/Kinematics", "test_kinematics", "test_effects"),
    in_cxx("lib/Motion", "test_motion", "test_control"),
    in_cxx("lib/GCode", "test_gcode"),
    in_cxx("lib/Settings", "test_settings"),
    in_cxx("src/machine", "test_machine", "test_control", "test_dialogues"),
    in_python(
        "tools/plumb/diagnosis",
        "diagnosis/test_limits.py",
        "diagnosis/test_slip_cause.py",
        "diagnosis/test_diagnose_parts.py",
        "diagnosis/test_diagnosis_numbers.py",
        "diagnosis/test_doubted.py",
        "diagnosis/test_smooth.py",
        "diagnosis/test_check_marks.py",
        "diagnosis/test_expected_error.py",
        "diagnosis/test_suspect_curves.py",
        "diagnosis/test_rounds_of_distances.py",
        "diagnosis/test_slips_in_repeats.py",
        "diagnosis/test_likeliest.py",
        "diagnosis/test_mixed_up.py",
        "diagnosis/test_halves.py",
    ),
    in_python(
        "tools/plumb/diary",
        "diary",
        "cli/test_diary_and_recheck.py",
        commands=("diary", "recheck"),
    ),
    in_python(
        "tools/plumb/recovery",
        "recovery",
        "cli/test_slip_and_home.py",
        commands=("slip", "home"),
    ),
    in_python("tools/plumb/jobs", "jobs", commands=("check", "resume")),
    in_python("tools/plumb/guide", "guide"),
    in_python("tools/plumb/line", "line"),
    in_python("tools/plumb/marks", "marks"),
    in_python("tools/plumb/fit", "fit"),
    in_python("tools/plumb/plan", "plan"),
    in_python("tools/plumb/report", "report"),
    in_python("tools/plumb/settings", "settings"),
)
