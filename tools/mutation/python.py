"""Python: mutants by cosmic-ray's operators, each judged by pytest in a process with that text."""

import ast
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator
from mutants import EQUIVALENT, KILLED, STILLBORN, SURVIVED, Mutant, Verdict

PYTEST = (sys.executable, "-m", "pytest", "-q", "--rootdir=.", "-p", "no:cacheprovider")
QUICK = 1.0  # [s] longer tests are left out of a quick look
HANGS = 10  # times the usual time, after which a mutant counts as fallen
# Those that make plausible slips; the others, like << for +, fall by their types alone.
KEYWORDS = (
    "AddNot",
    "NumberReplacer",
    "ReplaceAndWithOr",
    "ReplaceOrWithAnd",
    "ReplaceTrueWithFalse",
    "ReplaceFalseWithTrue",
    "ReplaceBreakWithContinue",
    "ReplaceContinueWithBreak",
    "ReplaceUnaryOperator_USub_UAdd",
    "ZeroIterationForLoop",
)
ARITHMETIC = ("Add_Sub", "Sub_Add", "Mul_Div", "Div_Mul", "Pow_Mul")
COMPARISONS = ("Lt_LtE", "Lt_Gt", "LtE_Lt", "LtE_Gt", "Gt_GtE", "Gt_Lt", "GtE_Gt", "GtE_Lt")
SAMENESS = ("Eq_NotEq", "NotEq_Eq", "Is_IsNot", "IsNot_Is")
OPERATORS = (
    *KEYWORDS,
    *(f"ReplaceBinaryOperator_{pair}" for pair in ARITHMETIC),
    *(f"ReplaceComparisonOperator_{pair}" for pair in (*COMPARISONS, *SAMENESS)),
)


@dataclass(frozen=True)
class Change:
    """A text of a file with one place changed."""

    mutant: Mutant
    text: str


class PythonRoom:
    """Files of a package, and the tests that judge them, the nearest first."""

    def __init__(self, root: Path, files: list[Path], tests: list[str], is_quick: bool):
        self.root, self.tests, self.is_quick = root, tests, is_quick
        self.changes = {
            change.mutant: change for file in files for change in changes_of(root, file)
        }

    def mutants(self) -> list[Mutant]:
        """All mutants of the files."""
        return list(self.changes)

    def judge(self, mutants: list[Mutant], tell: Callable[[Mutant, Verdict], None]) -> None:
        """Runs the tests on each mutant; the code as it stands must pass them first."""
        begun = time.monotonic()
        times = self.times()
        limit = HANGS * (time.monotonic() - begun)
        if self.is_quick:
            times = {test: taken for test, taken in times.items() if taken <= QUICK}
        self.tests = sorted(times, key=times.__getitem__)
        self.refuse_blind_runs(mutants[0])
        for mutant in mutants:
            tell(mutant, self.verdict(self.changes[mutant], limit))

    def refuse_blind_runs(self, mutant: Mutant) -> None:
        """The text as it stands must pass in the way that mutants are run, too."""
        file = Path(mutant.file)
        failed = self.failed_test(file, (self.root / file).read_text(), limit=None)
        if failed:
            sys.exit(f"{file} fails its tests without any mutant: {failed}")

    def times(self) -> dict[str, float]:
        """How long each test takes [s] on the code as it stands, which must pass them all."""
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "times.xml"
            command = [*PYTEST, "--junitxml", report, *self.tests]
            done = subprocess.run(command, cwd=self.root, capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"The tests fail without any mutant: {done.stdout.splitlines()[-1]}")
            cases = ElementTree.parse(report).iter("testcase")
            return {
                f"{case.get('classname').replace('.', '/')}.py::{case.get('name')}": float(
                    case.get("time")
                )
                for case in cases
            }

    def verdict(self, change: Change, limit: float) -> Verdict:
        """What becomes of a mutant."""
        file = Path(change.mutant.file)
        try:
            is_same = code_of(change.text) == code_of((self.root / file).read_text())
        except (SyntaxError, ValueError):
            return Verdict(STILLBORN)
        if is_same:
            return Verdict(EQUIVALENT)
        by = self.failed_test(file, change.text, limit=limit)
        return Verdict(KILLED, by) if by else Verdict(SURVIVED)

    def failed_test(self, file: Path, text: str, *, limit: float | None) -> str:
        """The first test that fails with this text for a file; nothing if all pass."""
        with tempfile.TemporaryDirectory() as folder:
            mutated = Path(folder) / "mutant.py"
            mutated.write_text(text)
            environment = {
                **os.environ,
                "PYTHONPATH": str(Path(__file__).parent),
                "PYTHONDONTWRITEBYTECODE": "1",
                "MUTATED_MODULE": module_of(file),
                "MUTATED_TEXT": str(mutated),
                "OMP_NUM_THREADS": "1",
                "OPENBLAS_NUM_THREADS": "1",
                # They would take as long to load as most tests take.
                "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
            }
            command = [*PYTEST, "-x", "--tb=no", "-p", "swapped_module", *self.tests]
            try:
                done = subprocess.run(
                    command,
                    cwd=self.root,
                    env=environment,
                    capture_output=True,
                    text=True,
                    timeout=limit,
                )
            except subprocess.TimeoutExpired:
                return "time"
        if done.returncode == 0:
            return ""
        failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
        return failed[0].split(" - ")[0] if failed else f"exit {done.returncode}"


def module_of(file: Path) -> str:
    """The name by which Python imports a file below tools; nothing for no file."""
    return ".".join(file.with_suffix("").parts[1:])


def code_of(text: str) -> bytes:
    """What Python runs of a text, whatever lines it stands on."""
    tree = ast.parse(text)
    return ast.dump(tree).encode()


def changes_of(root: Path, file: Path) -> Iterator[Change]:
    """Each change of a file by each operator."""
    text = (root / file).read_text()
    twins: dict[tuple[str, str], int] = {}
    for name in OPERATORS:
        operator = get_operator(f"core/{name}")()
        nodes = ast_nodes(get_ast(text))
        count = sum(len(list(operator.mutation_positions(node))) for node in nodes)
        for occurrence in range(count):
            changed = mutate_code(text, operator, occurrence)
            line, before, after = first_difference(text, changed or text)
            if line:
                twins[before, after] = twins.get((before, after), -1) + 1
                twin = twins[before, after]
                yield Change(Mutant(file.as_posix(), line, before, after, twin), changed)


def first_difference(text: str, changed: str) -> tuple[int, str, str]:
    """The number of the first line that differs, and that line in both; 0 if none does."""
    for number, lines in enumerate(zip(text.splitlines(), changed.splitlines(), strict=False), 1):
        if lines[0] != lines[1]:
            return number, lines[0].strip(), lines[1].strip()
    return 0, "", ""
