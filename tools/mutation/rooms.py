"""The rooms that are mutated, their files, and the suites that judge them, the nearest first."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from cxx import CxxRoom
from cxx_build import COPIED, Build, flags_of, layout_of
from python import PythonRoom

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / ".build/mutation"
BORROWED = ROOT / ".pio/libdeps/native"


@dataclass(frozen=True)
class Room:
    """A name for the command line, and what makes the room's mutants and judges them."""

    name: str
    open: Callable
    watched: tuple[str, ...]  # folders whose change voids the verdicts


def cxx(name: str, *suites: str) -> Room:
    """A folder of C++."""

    def opened(is_quick: bool) -> CxxRoom:
        folder = ROOT / name
        source = folder / "src" if (folder / "src").is_dir() else folder
        files = sorted(path for path in source.rglob("*") if path.suffix in (".h", ".cpp"))

        def build() -> Build:
            place = FOLDER / name.replace("/", "_")
            return Build(ROOT, place, layout_of(ROOT, list(suites)), BORROWED, flags_of(ROOT))

        return CxxRoom(ROOT, [path.relative_to(ROOT) for path in files], build, is_quick)

    return Room(name, opened, (*COPIED, "tools/mutation"))


def python(name: str, *tests: str, commands: tuple[str, ...] = ()) -> Room:
    """A folder of Python below tools, and the commands that say what it does."""

    def opened(is_quick: bool) -> PythonRoom:
        files = sorted(path.relative_to(ROOT) for path in (ROOT / name).glob("*.py"))
        files += [Path(f"tools/plumb/cli/{command}.py") for command in commands]
        return PythonRoom(ROOT, files, list(tests), is_quick)

    return Room(name, opened, ("tools/plumb", "tools/tests", "tools/mutation"))


ROOMS = (
    cxx("lib/Kinematics", "test_kinematics", "test_effects"),
    cxx("lib/Motion", "test_motion", "test_control"),
    cxx("lib/GCode", "test_gcode"),
    cxx("lib/Settings", "test_settings"),
    cxx("src/machine", "test_machine", "test_control", "test_dialogues"),
    python(
        "tools/plumb/diagnosis",
        "tools/tests/diagnosis/test_limits.py",
        "tools/tests/diagnosis/test_slip_cause.py",
        "tools/tests/diagnosis/test_diagnose_parts.py",
        "tools/tests/diagnosis/test_diagnosis_numbers.py",
        "tools/tests/diagnosis/test_doubted.py",
        "tools/tests/diagnosis/test_smooth.py",
        "tools/tests/diagnosis/test_check_marks.py",
        "tools/tests/diagnosis/test_expected_error.py",
        "tools/tests/diagnosis/test_suspect_curves.py",
        "tools/tests/diagnosis/test_rounds_of_distances.py",
        "tools/tests/diagnosis/test_slips_in_repeats.py",
        "tools/tests/diagnosis/test_likeliest.py",
        "tools/tests/diagnosis/test_mixed_up.py",
        "tools/tests/diagnosis/test_halves.py",
    ),
    python(
        "tools/plumb/diary",
        "tools/tests/diary",
        "tools/tests/cli/test_diary_and_recheck.py",
        commands=("diary", "recheck"),
    ),
    python(
        "tools/plumb/job",
        "tools/tests/job",
        "tools/tests/cli/test_slip_and_home.py",
        commands=("slip", "home"),
    ),
    python("tools/plumb/job", "tools/tests/job", commands=("check", "resume")),
    python("tools/plumb/guide", "tools/tests/guide"),
    python("tools/plumb/line", "tools/tests/line"),
    python("tools/plumb/marks", "tools/tests/marks"),
    python("tools/plumb/fit", "tools/tests/fit"),
    python("tools/plumb/plan", "tools/tests/plan"),
    python("tools/plumb/report", "tools/tests/report"),
    python("tools/plumb/settings", "tools/tests/settings"),
)
