"""A lab on a folder that is asked without a network, and forms for its tests."""

import time
from itertools import cycle

from example_machine import EXAMPLE
from fastapi.testclient import TestClient
from plumb.diary.file import FIT, append
from plumb.fit.compare import compare
from plumb.lab.app import lab_app
from plumb.lab.guard import Address
from plumb.lab.project import Project
from plumb.lab.rounds import inputs_of
from plumb.marks.read import from_edges

TOKEN = "t" * 32
ADDRESS = Address("127.0.0.1", 8123)
PATIENCE = 120  # [s] of a busy computer


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
    content = (EXAMPLE / "groundcontrol.ini").read_bytes()
    got(client.post("/api/settings", files={"file": ("groundcontrol.ini", content)}))
    return client


def with_marks(folder):
    """The same with the example's marks opened as well."""
    client = with_settings(folder)
    content = (EXAMPLE / "marks.toml").read_bytes()
    got(client.post("/api/marks", files={"file": ("marks.toml", content)}))
    return client


def got(answer, status=200):
    """The answer, which must have this status."""
    assert answer.status_code == status, answer.text
    return answer.json()


def choose(client, **change):
    """Change some choices, as the page does."""
    project = got(client.get("/api/project"))
    body = {"choices": {**project["choices"], **change}, "read": project["choices_digest"]}
    return got(client.put("/api/choices", json=body))


def write_correction(client, status=200):
    """Write what is accepted of the correction, as the page does."""
    project = got(client.get("/api/project"))
    settings = project["files"][project["choices"]["settings"]]
    body = {"settings": settings, "choices": project["choices_digest"]}
    return got(client.post("/api/correction", json=body), status)


def type_in(client, file, *offsets):
    """Each mark of a form is read so far [mm] from where it was sent; offsets take turns."""
    form = got(client.get("/api/readings", params={"file": file}))
    readings = []
    for mark, (x, y) in zip(form["marks"], cycle(offsets), strict=False):
        across, along = from_edges(mark["target"], sheet=form["sheet"], corner=form["edges"])
        readings.append({"index": mark["index"], "read": [across + x, along + y]})
    body = {key: form[key] for key in ("file", "digest", "edges")}
    return got(client.put("/api/readings", json={**body, "readings": readings}))


def awaited(client, path, true):
    """The first answer of a route of which this is so."""
    end = time.monotonic() + PATIENCE
    while not true(answer := got(client.get(f"/api/{path}"))):
        assert time.monotonic() < end, answer
        time.sleep(0.05)
    return answer


def finished(client, path):
    """The result of the background work, once it has ended."""
    return awaited(client, path, lambda answer: answer["share"] == 1)


def until(client, true):
    """The state of the machine once this is so."""
    return awaited(client, "machine", true)


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
        "settings": (EXAMPLE / "machine.toml").read_text().replace("2978.274402400813", str(gap)),
        "marks": [{}] * 9,
        "distances": [],
        "before_mm": 8.9,
        "rms_mm": rms,
        "left_out_mm": float("nan"),
        "effects": ["chain_sag"],
        "numbers": [number],
    }
    append(folder, FIT, content, at=at)
