"""What a report says of earlier rounds: by the diary, or by what the settings know."""

import pytest
from example_machine import checked
from plumb.settings.files import read_settings
from reports import EXAMPLE, Page, asked, board, reported
from synthetic import grid, marks_on

INI, MARKS = EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml"


def history(*words, folder) -> str:
    return Page(reported(*words, folder=folder)[1].part("history")).text


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("machine")


@pytest.fixture(scope="module")
def fitted(folder):
    """What a fit answered, and marks that its machine has made since."""
    done = asked("calibrate", INI, MARKS, *checked(), "-o", folder / "machine.toml")
    machine = read_settings(folder / "machine.toml")
    marks = marks_on(machine, machine, grid(3, 3), noise=0.5)
    return done["addition"], board(folder, marks, settings=machine)


def test_a_promise_of_the_last_fit_is_held_against_the_new_marks(fitted, folder):
    addition, new = fitted
    answer, page = reported(*new, "--cut-with", new[0], folder=folder)
    text = Page(page.part("history")).text
    assert f"The last fit promised {addition['after']['left_out_rms_mm']:.2f} mm RMS" in text
    assert f"lie {answer['comparison']['rms_mm']:.2f} mm off" in text
    assert "readings, as set then" in text


@pytest.mark.slow
def test_each_round_of_the_diary_has_its_place(fitted, folder):
    addition, new = fitted
    once = [asked("compare", INI, MARKS)["rms_mm"], addition["after"]["fit_rms_mm"]]
    asked("calibrate", *new, "--cut-with", new[0], "-o", folder / "again.toml", "--force")
    text = history(folder / "again.toml", MARKS, "--cut-with", INI, folder=folder)
    assert text.count("readings, as set then") == 2
    assert all(f"{size:.2f} mm" in text for size in once) and "Before these" not in text
    text = history(folder / "again.toml", new[1], "--cut-with", new[0], folder=folder)
    assert text.count("as set then") == text.count("Before these settings were") == 1
    (folder / "diary.jsonl").unlink()
    assert "marks.toml, as set then" in history(*new, "--cut-with", new[0], folder=folder)
    assert "first round" in history(INI, MARKS, folder=folder)
