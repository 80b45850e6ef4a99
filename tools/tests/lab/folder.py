"""A lab on a folder that is asked without a network, and forms for its tests."""

from pathlib import Path

from fastapi.testclient import TestClient
from plumb.diary.file import FIT, append
from plumb.fit.compare import compare
from plumb.lab.app import lab_app
from plumb.lab.guard import Address
from plumb.lab.project import Project
from plumb.lab.rounds import inputs_of

ROOT = Path(__file__).resolve().parents[3]
EXAMPLE = ROOT / "docs" / "example"
TOKEN = "t" * 32
ADDRESS = Address("127.0.0.1", 8123)


def asked(folder):
    """The lab of a folder, as its page asks it."""
    return TestClient(
        lab_app(folder, address=ADDRESS, token=TOKEN),
        base_url=f"http://127.0.0.1:{ADDRESS.port}",
        headers={"X-Plumb-Token": TOKEN},
    )


def compared(folder):
    """The opened settings of a folder against all its readings."""
    return compare(inputs_of(Project(folder)))


def with_settings(folder):
    """The same with the example's settings opened."""
    client = asked(folder)
    name = EXAMPLE / "groundcontrol.ini"
    answer = client.post("/api/settings", files={"file": ("groundcontrol.ini", name.read_bytes())})
    assert answer.status_code == 200, answer.text
    return client


def example_form(*, read=0):
    """The example's marks as a form of which the first are read."""
    head, *marks = (EXAMPLE / "marks.toml").read_text().split("\n[[mark]]\n")
    blank = [
        mark
        if i < read
        else "\n".join(
            "# measured = [ , ]" if line.startswith("measured") else line
            for line in mark.split("\n")
        )
        for i, mark in enumerate(marks)
    ]
    return "\n[[mark]]\n".join([head, *blank])


def note_fit(folder, at, rms, gap):
    """A fit in the folder's diary, with its error and the motor gap [mm]."""
    number = {"name": "motor_gap", "unit": "mm", "value": gap, "low": gap - 1, "high": gap + 1}
    content = {
        "machine": "machine.toml",
        "marks": [{}] * 9,
        "distances": [],
        "before_mm": 8.9,
        "rms_mm": rms,
        "left_out_mm": float("nan"),
        "effects": ["chain_sag"],
        "numbers": [number],
    }
    append(folder, FIT, content, at=at)
