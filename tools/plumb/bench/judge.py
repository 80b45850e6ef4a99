"""The judge's program: compiled when asked for, then kept running to hang one sled after another.

It shares no formula with the laws that the lab fits, so a slip in a law cannot hide the same slip
in the data.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import numpy as np

from plumb.text.errors import InputError

Array = np.ndarray
ROOT = Path(__file__).resolve().parents[3]
SOURCE = ROOT / "test/hidden/judge_marks.cpp"
EIGEN = ROOT / ".pio/libdeps/native/ArduinoEigen/ArduinoEigen"
PROGRAM = ROOT / ".build/hidden/judge_marks"
AT_ONCE = 200  # places asked for before the answers are read: fewer than fill a pipe

Numbers = Mapping[str, float]


def build() -> Path:
    """The judge's program, compiled if any of its sources is newer; InputError if it cannot be."""
    if not SOURCE.exists():
        raise InputError(
            f"{SOURCE}: the judge's program is missing; the bench runs only in a checkout of the "
            "project, after tools/setup"
        )
    sources = [SOURCE, *SOURCE.parents[1].glob("reference/*.h")]
    newest = max(one.stat().st_mtime for one in sources)
    if PROGRAM.exists() and PROGRAM.stat().st_mtime >= newest:
        return PROGRAM
    if not EIGEN.is_dir():
        raise InputError(f"{EIGEN}: Eigen is missing, which the judge needs; run tools/setup")
    PROGRAM.parent.mkdir(parents=True, exist_ok=True)
    # Into a file of its own first: several benches may build at once.
    fresh = PROGRAM.with_suffix(f".{os.getpid()}")
    options = ["-std=c++17", "-O2", "-I", str(ROOT / "test"), "-isystem", str(EIGEN)]
    try:
        done = subprocess.run(
            ["g++", *options, str(SOURCE), "-o", str(fresh)], capture_output=True, text=True
        )
    except FileNotFoundError:
        raise InputError(f"{SOURCE}: g++ is missing, which builds it; run tools/setup") from None
    if done.returncode:
        reason = next((line for line in done.stderr.splitlines() if "error" in line), "g++ failed")
        raise InputError(f"{SOURCE}: does not compile: {reason}")
    fresh.replace(PROGRAM)
    return PROGRAM


@dataclass
class Judge:
    """One running program."""

    program: Path
    _process: subprocess.Popen | None = field(default=None, repr=False)

    def places(self, numbers: Numbers, chains: Array, *, pushes: Array, weights: Array) -> Array:
        """Places (n, 2) [mm] of the sled of a machine with these numbers.

        chains (n, 2) [mm] paid out, pushes (n, 2) [N] on the sled, weights (n,) [N] of it. NaN
        where it cannot hang.
        """
        self._say(["usual", *(f"{name} {float(value)!r}" for name, value in numbers.items())])
        asked = [
            f"sled_weight {float(weight)!r}\nplace {paid[0]!r} {paid[1]!r} {push[0]!r} {push[1]!r}"
            for paid, push, weight in zip(
                chains.tolist(), pushes.tolist(), weights.tolist(), strict=True
            )
        ]
        found = []
        for start in range(0, len(asked), AT_ONCE):
            own = asked[start : start + AT_ONCE]
            self._say(own)
            found += [self._heard() for _ in own]
        return np.array(found, dtype=float).reshape(-1, 2)

    def _say(self, lines: list[str]) -> None:
        if self._process is None or self._process.poll() is not None:
            self._process = subprocess.Popen(
                [self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
            )
        self._process.stdin.write("\n".join(lines) + "\n")
        self._process.stdin.flush()

    def _heard(self) -> list[str]:
        line = self._process.stdout.readline().split()
        if len(line) != 2:
            raise InputError(f"{self.program}: the judge stopped; build it again with tools/setup")
        return line


@lru_cache(maxsize=1)
def judge() -> Judge:
    """The judge that all boards of this program share."""
    return Judge(build())
