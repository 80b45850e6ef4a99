"""The page in a real browser."""

from plumb.cure.machine_file import SETTINGS


def test_a_settings_file_opens_the_next_steps(lab, page):
    page.goto(lab.url)
    assert page.get_by_role("link", name="Readings").count() == 0
    page.get_by_label("Settings' file").set_input_files(SETTINGS)
    page.get_by_role("link", name="Readings").wait_for()
    assert (lab.folder / "groundcontrol.ini").read_bytes() == SETTINGS.read_bytes()


def test_a_bad_file_is_refused_in_a_line_and_changes_nothing(lab, page, tmp_path):
    page.goto(lab.url)
    bad = tmp_path / "holiday.ini"
    bad.write_text("no settings\n")
    page.get_by_label("Settings' file").set_input_files(bad)
    assert "holiday.ini" in page.get_by_role("alert").inner_text()
    assert not (lab.folder / "groundcontrol.ini").exists()
