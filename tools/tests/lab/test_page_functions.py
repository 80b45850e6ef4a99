"""Functions of the page that need no browser: their tests in JavaScript lie next to them."""

import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "lab"
NODE = Path(sys.executable).parent / "node"


def test_the_pages_functions_pass_their_tests():
    done = subprocess.run(
        [NODE, "--test", "--test-reporter", "tap", "src/**/*.test.js"],
        cwd=PAGE,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    assert "# pass 0" not in done.stdout
