"""tools/demo: what is hidden in a virtual machine is named, and the error falls."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.mark.slow
def test_the_demo_ends_with_the_hidden_effect_named_and_a_better_machine():
    program = [ROOT / "tools/demo", "--seed", "2"]
    said = subprocess.run(program, capture_output=True, text=True, check=True).stdout
    played, revealed = said.split("$ plumb practice reveal")
    assert "chain_stretch" not in played
    assert "Hidden was chain_stretch" in revealed and "You found chain stretch." in revealed
    before, after = map(float, re.findall(r"\d\.\d+$", revealed, re.MULTILINE))
    assert after < 0.2 * before
    assert "The machine is as it was fitted" in played
    assert (ROOT / "build/demo/error-falls.png").read_bytes().startswith(b"\x89PNG")
