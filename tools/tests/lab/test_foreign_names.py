"""Names from files of others are text on the page: nothing in them runs."""

from screens import measured_machine, walk
from served_lab import serve

EVIL = "<img src=x onerror=window.ran=1>"


def test_nothing_in_a_name_runs_and_the_name_is_shown(tmp_path, browser):
    folder = measured_machine(tmp_path / f"garage {EVIL}")
    marks = folder / "marks.toml"
    text = marks.read_text()
    assert 'name = "1"' in text
    marks.write_text(text.replace('name = "1"', f"name = '{EVIL}'"))
    served = serve(folder)
    context = browser.new_context()
    page = context.new_page()
    dialogs, shown = [], []
    page.on("dialog", lambda dialog: (dialogs.append(dialog.message), dialog.dismiss()))
    try:
        page.goto(served.url)
        page.get_by_text(f"garage {EVIL}").wait_for()
        for name in walk(page):
            assert page.evaluate("() => window.ran") is None, name
            assert page.locator("img[onerror]").count() == 0, name
            if page.locator("main").get_by_text(EVIL).count():
                shown.append(name)
    finally:
        context.close()
        served.end()
    assert dialogs == []
    assert "readings" in shown
