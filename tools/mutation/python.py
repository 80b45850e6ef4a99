"""Python: mutants by cosmic-ray's operators, each judged by pytest in a process with that text."""

import ast
import os
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator
from mutants import KILLED, SAME, STILLBORN, SURVIVED, Mutant, Site, code_of, tested

PYTEST = (sys.executable, "-m", "pytest", "-q", "-x", "--tb=no", "--rootdir=.")
PLUGINS = ("-m", "not slow", "-p", "no:cacheprovider", "-p", "swapped_module")
# Those that make plausible slips; the others, like << for +, fall by their types alone.
PLAIN = (
    "AddNot NumberReplacer ReplaceAndWithOr ReplaceOrWithAnd ReplaceTrueWithFalse "
    "ReplaceFalseWithTrue ReplaceBreakWithContinue ReplaceContinueWithBreak "
    "ReplaceUnaryOperator_USub_UAdd ZeroIterationForLoop"
)
ARITHMETIC = "Add_Sub Sub_Add Mul_Div Div_Mul Pow_Mul"
COMPARISON = (
    "Lt_LtE Lt_Gt LtE_Lt LtE_Gt Gt_GtE Gt_Lt GtE_Gt GtE_Lt Eq_NotEq NotEq_Eq Is_IsNot IsNot_Is"
)
OPERATORS = (
    *PLAIN.split(),
    *(f"ReplaceBinaryOperator_{pair}" for pair in ARITHMETIC.split()),
    *(f"ReplaceComparisonOperator_{pair}" for pair in COMPARISON.split()),
)


def sites(root: Path, file: Path) -> Iterator[Site]:
    """Yield each change of a file by each operator, in the file's order."""
    text = (root / file).read_text()
    lines, nodes = text.splitlines(), list(ast_nodes(get_ast(text)))
    scopes = scopes_of(text)
    seen = []
    for name in OPERATORS:
        operator = get_operator(f"core/{name}")()
        places = [place for node in nodes for place in operator.mutation_positions(node)]
        for occurrence, ((line, column), _) in enumerate(places):
            change = partial(mutate_code, text, operator, occurrence)
            site = Site(file, line, scopes.get(line, ""), code_of(lines[line - 1]), change)
            seen.append((line, column, site))
    yield from (site for _, _, site in sorted(seen, key=lambda each: each[:2]))


def scopes_of(text: str) -> dict[int, str]:
    """Return the innermost function or class of each line, with those around it."""
    scopes: dict[int, str] = {}

    def walk(node: ast.AST, around: str) -> None:
        for child in ast.iter_child_nodes(node):
            inside = around
            if isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                inside = f"{around}.{child.name}".lstrip(".")
                first = min(each.lineno for each in (child, *child.decorator_list))
                last = child.end_lineno or child.lineno
                scopes.update(dict.fromkeys(range(first, last + 1), inside))
            walk(child, inside)

    walk(ast.parse(text), "")
    return scopes


class Judge:
    """The tests of a room. They must pass with the text of a file as it stands."""

    def __init__(self, root: Path, folder: Path, tests: tuple[str, ...], file: Path):
        self.root, self.tests = root, tests
        passes, self.usual = self.run(file, (root / file).read_text(), None)
        if not passes:
            sys.exit(f"The tests of {file} fail without any mutant.")

    def outcome(self, mutant: Mutant) -> str:
        """Return what becomes of a mutant."""
        file = mutant.site.file
        try:
            is_same = ast.dump(ast.parse(mutant.text)) == ast.dump(
                ast.parse((self.root / file).read_text())
            )
        except (SyntaxError, ValueError):
            return STILLBORN
        if is_same:
            return SAME
        return SURVIVED if self.run(file, mutant.text, self.usual)[0] else KILLED

    def run(self, file: Path, text: str, usual: float | None) -> tuple[bool, float]:
        """Return whether all tests pass with this text for a file, and their time."""
        with tempfile.NamedTemporaryFile("w", suffix=".py") as mutated:
            mutated.write(text)
            mutated.flush()
            environment = {
                **os.environ,
                "PYTHONPATH": str(Path(__file__).parent),
                "PYTHONDONTWRITEBYTECODE": "1",
                "MUTATED_MODULE": ".".join(file.with_suffix("").parts[1:]),
                "MUTATED_TEXT": mutated.name,
                "OMP_NUM_THREADS": "1",
                "OPENBLAS_NUM_THREADS": "1",
                # They would take as long to load as most tests take.
                "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
            }
            return tested([*PYTEST, *PLUGINS, *self.tests], self.root, environment, usual)
