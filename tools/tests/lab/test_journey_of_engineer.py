"""An engineer's first day: looks where and why it fails, tries an effect, and the error falls."""

import csv
import html
import re
import xml.etree.ElementTree as ET

from journeys import GAP, Person
from lab_machine import PATIENCE
from playwright.sync_api import expect
from plumb.model.plain import noun_of

MARKS = 9


def saved(person, button):
    """The text of a file that a button saves."""
    with person.page.expect_download(timeout=PATIENCE) as download:
        person.press(button)
    return download.value.path().read_text("utf-8")


def look_where_it_fails(person, noun):
    """Plots, the fingerprint of the suspect over them, two states, and files to take along."""
    page = person.page
    person.go_to("Verdict")
    person.see(re.compile("The error falls from"))
    sentence = page.locator(".say").first.inner_text()
    assert noun in sentence
    expect(page.locator("svg.plot").nth(7)).to_be_attached(timeout=PATIENCE)
    person.press("^Lay it over the marks$")
    expect(page.locator(".sheet .print path")).to_have_count(MARKS, timeout=PATIENCE)
    expect(page.locator(".plots .key.laid")).to_contain_text(noun)
    assert page.locator(".plot .curve:not(.noise), .plot .strokes").count() >= 8
    drawn = page.locator(".sheet .arrow").first.get_attribute("d")
    page.locator(".sheet .board").press("[")
    expect(page.get_by_role("radio", name="as set")).to_be_checked()
    assert page.locator(".sheet .arrow").first.get_attribute("d") != drawn
    page.locator(".sheet .tools summary").click()
    rows = list(csv.DictReader(saved(person, "^Data as CSV$").splitlines()))
    assert len(rows) == 3 * MARKS and {row["state"] for row in rows} >= {"as set", "frame fitted"}
    ET.fromstring(saved(person, "^Picture as SVG$"))
    assert sentence in html.unescape(saved(person, "^Save the report$"))


def try_an_effect(person, noun):
    """On the bench: the error falls; a slider takes it up again, and the fit back down [mm]."""
    page = person.page
    person.go_to("Effects bench")
    left = page.locator(".fall-now output")

    def error():
        return float(left.inner_text().removesuffix(" mm"))

    expect(left).to_contain_text("mm", timeout=PATIENCE)
    frame = left.inner_text()
    person.tick(f"^{noun}")
    expect(left).not_to_have_text(frame, timeout=PATIENCE)
    fitted = left.inner_text()
    assert error() < 0.6 * float(frame.removesuffix(" mm"))
    page.get_by_role("slider").first.press("Home")
    expect(left).not_to_have_text(fitted, timeout=PATIENCE)
    assert error() > float(fitted.removesuffix(" mm"))
    person.press("^Fit: ")
    expect(left).to_have_text(fitted, timeout=PATIENCE)


def test_an_engineer_sees_why_and_the_error_falls_on_the_machine_at_its_port(lab, page, garage):
    engineer = Person(page, lab)
    engineer.connect(garage.path)
    engineer.see(re.compile(rf"motors {engineer.number(GAP):.1f} mm apart"))
    engineer.cut(garage)
    first = engineer.type_readings(garage, "marks.toml")
    (hidden,) = garage.hidden.effects
    look_where_it_fails(engineer, noun_of(hidden))
    try_an_effect(engineer, noun_of(hidden))
    engineer.go_to("Correct")
    engineer.press("^Accept all")
    engineer.write_and_send()
    engineer.lay_next_sheet(garage)
    engineer.cut(garage)
    assert engineer.type_readings(garage, "marks-2.toml") < 0.3 * first
