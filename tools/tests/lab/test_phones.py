"""Phones are paired by a PIN and do what the computer lets them; strangers get nothing."""

import re

import pytest
from fastapi.testclient import TestClient
from folder import ADDRESS, EXAMPLE, TOKEN, example_form, got, with_settings
from playwright.sync_api import expect
from plumb.lab.app import lab_app
from plumb.lab.routes import phones
from plumb.lab.routes.phones import Phones
from screens import at_rest, axe_findings
from served_lab import serve
from starlette.websockets import WebSocketDisconnect
from test_readings_page import LEFT, type_in

FAR = "192.168.1.5"
NETWORK = "127.0.0.2"  # another address of this computer: the lab takes it for the network


@pytest.fixture
def home(tmp_path):
    """A shared lab: its phones, and browsers on the computer and in the network."""
    with_settings(tmp_path)
    paired = Phones("hands", port=ADDRESS.port, say=lambda text: None)
    app = lab_app(tmp_path, address=ADDRESS, token=TOKEN, paired=paired)

    def browser(host, **headers):
        return TestClient(app, base_url=f"http://{host}:{ADDRESS.port}", headers=headers)

    return paired, browser


def pair(home, pin=None):
    """A browser in the network, paired with the lab's PIN."""
    paired, browser = home
    phone = browser(FAR)
    body = {"pin": pin or paired.invitation.pin, "kind": "iPhone"}
    return phone, phone.post("/api/phones/pair", json=body)


def reading(phone, x):
    """Type a reading of mark 1 as the page does."""
    form = got(phone.get("/api/readings"))
    body = {key: form[key] for key in ("file", "digest", "edges")}
    return phone.put("/api/readings", json={**body, "readings": [{"index": 0, "read": [x, 100]}]})


def test_a_stranger_in_the_network_gets_the_page_and_nothing_else(home):
    _, browser = home
    for headers in ({}, {"X-Plumb-Token": TOKEN}, {"Cookie": f"plumb-phone={TOKEN}"}):
        stranger = browser(FAR, **headers)
        assert stranger.get("/").status_code == 200
        for way in ("project", "machine", "phones", "phones/me", "report.html"):
            assert stranger.get(f"/api/{way}").status_code == 401, way
        assert stranger.post("/api/machine/stop").status_code == 401


def test_a_paired_phone_types_reads_and_stops_and_does_the_rest_once_allowed(home, tmp_path):
    paired, browser = home
    computer = browser("127.0.0.1", **{"X-Plumb-Token": TOKEN})
    (tmp_path / "marks.toml").write_text(example_form())
    phone, answer = pair(home)
    assert got(answer)["name"] == "iPhone 1" and not got(answer)["may_move"]
    cookie = answer.headers["set-cookie"]
    assert "HttpOnly" in cookie and "SameSite=strict" in cookie
    assert got(reading(phone, 98))["marks"][0]["read"] == [98, 100]
    for way in ("stop", "hold"):  # no machine is there, which is another refusal
        assert phone.post(f"/api/machine/{way}").status_code == 422
    project = got(phone.get("/api/project"))
    body = {"choices": project["choices"], "read": project["choices_digest"]}
    change = ("PUT", "/api/choices"), ("POST", "/api/machine/disconnect")
    for method, way in change:
        assert "allow more" in got(phone.request(method, way, json=body), 403)["error"]
    for way in ("/api/phones", "/api/phones/", "/api/phones/1/let", "/api/phones/pair"):
        assert phone.get(way).status_code == 403, way
    got(computer.post("/api/phones/1/let", json={"may_move": True}))
    for method, way in change:
        got(phone.request(method, way, json=body))
    assert phone.post("/api/phones/1/send-away").status_code == 403
    assert got(computer.post("/api/phones/1/send-away"))["phones"] == []
    assert phone.get("/api/project").status_code == 401
    assert paired.paired == []


def test_a_pin_is_good_for_a_single_phone_and_five_wrong_ones_cost_a_minute(home, monkeypatch):
    paired, _ = home
    first = paired.invitation.pin
    got(pair(home, first)[1])
    assert "not the PIN" in got(pair(home, first)[1], 422)["error"]
    second = paired.invitation.pin
    for _ in range(phones.TRIES - 1):
        got(pair(home, "x")[1], 422)
    assert "too many" in got(pair(home, second)[1], 422)["error"]
    third = paired.invitation.pin
    assert third != second and "wait" in got(pair(home, third)[1], 422)["error"]
    later = phones.monotonic() + phones.WAIT_S
    monkeypatch.setattr(phones, "monotonic", lambda: later)
    assert got(pair(home, third)[1])["name"] == "iPhone 2"


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": f"plumb.example:{ADDRESS.port}"},
        {"Host": f"127.0.0.1:{ADDRESS.port}"},
        {"Origin": "http://plumb.example"},
        {"Origin": f"http://127.0.0.1:{ADDRESS.port}"},
        {"Sec-Fetch-Site": "cross-site"},
    ],
)
def test_another_sites_page_in_a_phones_browser_is_refused(home, headers):
    phone, answer = pair(home)
    got(answer)
    assert got(phone.post("/api/machine/stop", headers=headers), 403)["error"]
    assert "plumb-phone" not in phone.get("/", headers=headers).headers.get("set-cookie", "")


def test_share_move_needs_no_permission_and_without_share_no_phone_pairs(tmp_path):
    with_settings(tmp_path)
    moving = Phones("move", say=lambda text: None)
    assert moving.pair(moving.invitation.pin, "phone")[1].may_move
    alone = lab_app(tmp_path, address=ADDRESS, token=TOKEN)
    computer = TestClient(alone, base_url=f"http://127.0.0.1:{ADDRESS.port}")
    said = got(computer.get("/api/phones", headers={"X-Plumb-Token": TOKEN}))
    assert said == {"invitation": None, "phones": []}


@pytest.fixture
def shared_lab(tmp_path):
    """`plumb lab --share` on a folder with a form that waits, and the PIN that it prints."""
    settings = EXAMPLE / "groundcontrol.ini"
    (tmp_path / settings.name).write_bytes(settings.read_bytes())
    (tmp_path / "marks.toml").write_text(example_form())
    lab = serve(tmp_path, options=["--share"])
    pins = (re.search(r"PIN\D*(\d{6})", line) for line in lab.process.stdout)
    pin = next(found[1] for found in pins if found)
    yield lab, pin
    lab.end()


def test_a_phone_that_scans_the_code_types_readings_until_it_is_sent_away(
    shared_lab, page, open_page
):
    lab, pin = shared_lab
    phone = open_page(viewport={"width": 390, "height": 844}, user_agent="Android")
    phone.goto(f"http://{NETWORK}:{lab.port}/#/pair/{pin}")
    phone.get_by_text("Android 1 may look, type readings, hold and stop").wait_for()
    assert phone.url.endswith("#/readings") and pin not in phone.url
    phone.get_by_label(LEFT.format(1), exact=True).wait_for()
    type_in(phone, 1, "98", "106")
    at_rest(phone)
    assert "measured = [98" in (lab.folder / "marks.toml").read_text()
    page.goto(lab.url)
    page.get_by_role("button", name="Let Android 1 move the machine").click()
    expect(phone.get_by_text("hold and stop")).to_have_count(0)
    assert axe_findings(page) == []
    page.get_by_role("button", name="Send Android 1 away").click()
    phone.get_by_role("heading", name="Pair this phone").wait_for()
    assert axe_findings(phone) == []


def test_the_live_line_of_a_phone_ends_when_it_is_sent_away(home):
    paired, _ = home
    phone, answer = pair(home)
    got(answer)
    line = f"ws://{FAR}:{ADDRESS.port}/api/live"
    with phone.websocket_connect(line, subprotocols=["plumb"]) as live:
        live.receive_json()
        paired.send_away(1)
        with pytest.raises(WebSocketDisconnect):
            for _ in range(5):  # what was on its way
                live.receive_json()
    with pytest.raises(WebSocketDisconnect), phone.websocket_connect(line):
        pass
