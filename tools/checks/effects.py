"""Each header of an effect has its line in the registry, lib/Kinematics/src/effects.h."""

import re
from collections.abc import Iterator
from pathlib import Path

import tree

REGISTRY = "lib/Kinematics/src/effects.h"
DECLARED = re.compile(r"^struct (\w+) : Effect<Real>", re.MULTILINE)


def violations(root: Path) -> Iterator[str]:
    """Yield each header without its line or its include, a line each."""
    registry = tree.text_of(root / REGISTRY)
    for path in sorted((root / REGISTRY).with_suffix("").glob("*.h")):
        name = path.relative_to(root)
        declared = DECLARED.search(tree.text_of(path))
        if declared is None:
            yield f"{name}: declares no effect: write struct NAME : Effect<Real>"
            continue
        if f'#include "effects/{path.name}"' not in registry:
            yield f'{name}: is not included: write #include "effects/{path.name}" in {REGISTRY}'
        if not re.search(rf"At<\d+, {declared[1]}>", registry):
            yield (
                f"{name}: has no setting: give it a line At<NUMBER, {declared[1]}> in {REGISTRY}, "
                "with a number between those of its neighbours"
            )


if __name__ == "__main__":
    tree.run(violations, "effects: each has its line in the registry")
