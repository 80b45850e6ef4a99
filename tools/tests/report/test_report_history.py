"""What a report says of earlier rounds: by the diary, or by what the settings know."""

from plumb.settings.files import read_settings
from reports import EXAMPLE, Page, asked, board, reported
from synthetic import grid, marks_on

INI, MARKS = EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml"
TAPE = ("--checked", "tape_scale.strain=0+-0.0001")


def history(*words, folder) -> str:
    return Page(reported(*words, folder=folder)[1].part("history")).text


def test_a_promise_of_the_last_fit_is_held_against_the_new_marks(tmp_path):
    done = asked("calibrate", INI, MARKS, *TAPE, "-o", tmp_path / "machine.toml")
    machine = read_settings(tmp_path / "machine.toml")
    new = board(tmp_path, marks_on(machine, machine, grid(3, 3), noise=0.5), settings=machine)
    answer, page = reported(*new, "--cut-with", new[0], folder=tmp_path)
    text = Page(page.part("history")).text
    promised = done["addition"]["after"]["left_out_rms_mm"]
    assert f"The last fit promised {promised:.2f} mm RMS" in text
    assert f"lie {answer['comparison']['rms_mm']:.2f} mm off" in text
    assert "readings, as set then" in text
    once = [asked("compare", INI, MARKS)["rms_mm"], done["addition"]["after"]["fit_rms_mm"]]
    asked("calibrate", *new, "--cut-with", new[0], "-o", tmp_path / "again.toml", "--force")
    text = history(tmp_path / "again.toml", MARKS, "--cut-with", INI, folder=tmp_path)
    assert text.count("readings, as set then") == 2
    assert all(f"{size:.2f} mm" in text for size in once) and "Before these" not in text
    text = history(tmp_path / "again.toml", new[1], "--cut-with", new[0], folder=tmp_path)
    assert text.count("as set then") == text.count("Before these settings were") == 1
    (tmp_path / "diary.jsonl").unlink()
    assert "marks.toml, as set then" in history(*new, "--cut-with", new[0], folder=tmp_path)
    assert "first round" in history(INI, MARKS, folder=tmp_path)
