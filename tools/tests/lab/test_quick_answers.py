"""How soon an answer is there: a slider of the bench asks for one many times a second."""

import json
import socket
import time
from pathlib import Path

import plumb.lab.rounds
from folder import got, with_marks
from playwright.sync_api import expect
from screens import at_rest, measured_machine

ROOT = Path(__file__).resolve().parents[3]
MOST_S = 0.03  # after its header; a body that waits for a receipt comes after 0.04
# Moves a slider each 10 ms, and counts how often the arrows move with it.
SLIDE = """() => new Promise((done) => {
  const slider = document.querySelector(".held input");
  const [low, high] = [Number(slider.min), Number(slider.max)];
  const frames = [];
  let [moves, last, i] = [0, "", 0];
  const look = (now) => {
    frames.push(now);
    const drawn = document.querySelector(".sheet path.arrow.beyond, .sheet path.arrow.within");
    const place = drawn?.getAttribute("d") ?? "";
    if (place !== last) moves += 1;
    last = place;
    if (i < 300) return requestAnimationFrame(look);
    const gaps = frames.slice(1).map((at, k) => at - frames[k]).sort((a, b) => a - b);
    done({ moves: (1000 * moves) / (frames.at(-1) - frames[0]), gap: gaps[gaps.length >> 1] });
  };
  requestAnimationFrame(look);
  const timer = setInterval(() => {
    i += 1;
    slider.value = String(low + ((high - low) * ((i * 3) % 200)) / 200);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    if (i >= 300) clearInterval(timer);
  }, 10);
})"""


def body_after_header(lab):
    """How long the body of an answer comes after its header [s]."""
    with socket.create_connection(("127.0.0.1", lab.port)) as line:
        head = f"GET /api/project HTTP/1.1\r\nHost: 127.0.0.1:{lab.port}\r\n"
        line.sendall(f"{head}X-Plumb-Token: {lab.token}\r\nX-Plumb-Tab: t\r\n\r\n".encode())
        text = b""
        while b"\r\n\r\n" not in text:
            text += line.recv(65536)
        start = time.monotonic()
        head, _, body = text.partition(b"\r\n\r\n")
        length = int(head.lower().split(b"content-length: ")[1].split(b"\r\n")[0])
        while len(body) < length:
            body += line.recv(65536)
        json.loads(body)
        return time.monotonic() - start


def test_no_body_waits_for_the_receipt_of_its_header(lab):
    measured_machine(lab.folder)
    assert min(body_after_header(lab) for _ in range(20)) < MOST_S


def test_a_refit_reads_no_marks_again(tmp_path, monkeypatch):
    client = with_marks(tmp_path)
    body = {"effects": ["chain_pitch"], "held": {"chain_pitch.left": 0.001}}
    first = got(client.post("/api/bench/fit", json=body))
    assert "groundcontrol.ini marks.toml" in first["command"]
    monkeypatch.setattr(plumb.lab.rounds, "read_form", None)
    monkeypatch.setattr(plumb.lab.rounds, "settings_in", None)
    body["held"]["chain_pitch.left"] = 0.002
    assert got(client.post("/api/bench/fit", json=body))["fit_rms"] != first["fit_rms"]


def test_a_slider_moves_the_arrows_many_times_a_second(lab, page):
    """30 a second is the goal on an idle computer; the figure lies in .build/lab."""
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/bench")
    page.get_by_role("checkbox", name="chains too long").check()
    page.get_by_role("slider", name="left chain too long").wait_for()
    at_rest(page)
    seen = page.evaluate(SLIDE)
    (ROOT / ".build/lab").mkdir(parents=True, exist_ok=True)
    (ROOT / ".build/lab/slider.txt").write_text(
        f"{seen['moves']:.0f} moves of the arrows a second, {seen['gap']:.1f} ms between frames\n"
    )
    assert seen["moves"] > 3
    # Where the slider rests, the plots and the large number are of the newest fit.
    left = page.locator(".fall-now output")
    expect(left).to_contain_text("mm")
    state = page.locator(".states label").last
    at_rest(page)
    assert f"{left.inner_text()} noise leaves" in " ".join(state.inner_text().split())
