"""Attacks on a served lab, as bytes on a socket: what a browser would never send, a program can."""

import json
import socket
from contextlib import suppress
from dataclasses import dataclass

CHOICES = json.dumps({"choices": {"units": "inch"}, "read": ""}).encode()
DISPOSITION = b'Content-Disposition: form-data; name="file"; filename="%s"'
FORM = b"--x\r\n" + DISPOSITION + b"\r\n\r\nno settings\r\n--x--\r\n"
BOUNDARY = "multipart/form-data; boundary=x"


@dataclass(frozen=True)
class Try:
    """A request that must be refused. None takes a header away."""

    method: str = "PUT"
    target: str = "/api/choices"
    headers: tuple[tuple[str, str | None], ...] = ()
    body: bytes = CHOICES

    def bytes(self, lab) -> bytes:
        """The request to this lab: all is right with it but what this attack changes."""
        usual = {"Host": f"127.0.0.1:{lab.port}", "X-Plumb-Token": lab.token}
        usual |= {"Content-Type": "application/json", "Content-Length": str(len(self.body))}
        changed = [(name, self.filled(text, lab)) for name, text in self.headers]
        names = {name.lower() for name, _ in changed}
        kept = [(name, text) for name, text in usual.items() if name.lower() not in names]
        lines = [f"{name}: {text}" for name, text in kept + changed if text is not None]
        first = f"{self.method} {self.filled(self.target, lab)} HTTP/1.1"
        return "\r\n".join([first, *lines, "", ""]).encode("latin-1") + self.body

    def filled(self, text: str | None, lab) -> str | None:
        """The text with this lab's port and token, and what differs from them by a little."""
        if text is None:
            return None
        for name, value in {"PORT": lab.port, "NEXT": lab.port + 1, "TOKEN": lab.token}.items():
            text = text.replace(f"<{name}>", f"{value}")
        return text


def with_header(name, *values, **rest):
    """A try for each value of a header."""
    return [Try(headers=((name, value),), **rest) for value in values]


FOREIGN_HOSTS = ("evil.example", "evil.example:<PORT>", "127.0.0.1.evil.example:<PORT>")
FOREIGN_HOSTS += ("localhost.evil.example:<PORT>", "127.0.0.1", "127.0.0.1:<NEXT>")
FOREIGN_HOSTS += ("127.0.0.1:<PORT>@evil.example", "[::1]:<PORT>", "0.0.0.0:<PORT>", "127.1:<PORT>")
FOREIGN_HOSTS += ("2130706433:<PORT>", "", None)
FOREIGN_ORIGINS = ("http://evil.example", "null", "", "http://127.0.0.1:<NEXT>")
FOREIGN_ORIGINS += ("https://127.0.0.1:<PORT>", "http://127.0.0.1")
FOREIGN_ORIGINS += ("http://localhost.evil.example:<PORT>", "http://127.0.0.1:<PORT>.evil.example")
FOREIGN_ORIGINS += ("http://127.0.0.1:<PORT>/", "file://")
WRONG_KEYS = (None, "", "x", "<TOKEN>x", "x<TOKEN>", "<TOKEN>, <TOKEN>", "*", "\xff\xfe")
SIMPLE = ("text/plain", "application/x-www-form-urlencoded", BOUNDARY)
OUTSIDE = (
    "/../secret.ini",
    "/../../../../../../etc/passwd",
    "/%2e%2e/secret.ini",
    "/%2e%2e%2fsecret.ini",
    "/..%2fsecret.ini",
    "/..%5csecret.ini",
    "/%252e%252e/secret.ini",
    "//etc/passwd",
    "/%2fetc%2fpasswd",
    "/./.lab.token",
    "/.lab.token",
    "/lab.json",
    "/groundcontrol.ini",
    "/index.html/../../guard.py",
    "/../guard.py",
    "/%00",
    "/index.html%00.ini",
    "/api/../../guard.py",
    "/api/settings/../../secret.ini",
)
NAMES = ("../secret.ini", "..", ".", "/etc/passwd", "a/b.ini", "a\\b.ini", ".lab.token", "~/x.ini")
NAMES += ("x.ini\n", "x\0.ini", "C:\\x.ini", "x" * 65, "\u2025/secret.ini")


def chosen(**choices):
    """The body that makes these the choices."""
    return json.dumps({"choices": choices, "read": ""}).encode()


def odd_headers():
    """Headers that no client of ours sends."""
    yield from with_header("Content-Length", "abc", "-1", "1e9", "+5", "0x10", "9" * 40, "5, 6")
    yield from with_header("Content-Length", "\xb2", "")
    yield Try(headers=(("Content-Length", "5"), ("Content-Length", "6")))
    yield from with_header("Transfer-Encoding", "gzip", "chunked, chunked", "identity")
    yield Try(headers=(("X-Long", "x" * 100_000),))
    yield Try(headers=tuple((f"X-{n}", "x" * 100) for n in range(2000)))
    yield Try(target="/api/" + "x" * 200_000)
    yield from with_header("X-Line", "a\x00b")
    yield Try(headers=(("Bad Name", "x"),))
    yield from with_header("Content-Type", "", "x", "application/json; charset=utf-9x", body=b"{")


ATTACKS = {
    "another host's name (DNS rebinding)": [
        *with_header("Host", *FOREIGN_HOSTS),
        *with_header("Host", *FOREIGN_HOSTS, method="GET", target="/api/project", body=b""),
        *with_header("Host", *FOREIGN_HOSTS, method="GET", target="/", body=b""),
        Try(headers=(("Host", "127.0.0.1:<PORT>"), ("Host", "evil.example"))),
        Try(headers=(("Host", "evil.example"), ("Host", "127.0.0.1:<PORT>"))),
        Try("GET", "http://evil.example/api/project", body=b""),
    ],
    "another site's page (CSRF)": [
        *with_header("Origin", *FOREIGN_ORIGINS),
        *with_header("Origin", *FOREIGN_ORIGINS, method="GET", target="/api/project", body=b""),
        *with_header("Sec-Fetch-Site", "cross-site", "same-site", ""),
        Try(headers=(("Origin", "http://127.0.0.1:<PORT>"), ("Origin", "http://evil.example"))),
        *with_header("Origin", *FOREIGN_ORIGINS, method="POST", target="/api/settings"),
    ],
    "no key, or a wrong key": [
        *with_header("X-Plumb-Token", *WRONG_KEYS),
        *with_header("X-Plumb-Token", *WRONG_KEYS, method="GET", target="/api/project", body=b""),
        Try(target="/api/choices?token=<TOKEN>", headers=(("X-Plumb-Token", None),)),
        Try(headers=(("X-Plumb-Token", None), ("Cookie", "token=<TOKEN>"))),
        Try(headers=(("X-Plumb-Token", None), ("Authorization", "Bearer <TOKEN>"))),
    ],
    "a form of another page (no preflight)": [
        Try("POST", target, (("X-Plumb-Token", None), ("Content-Type", kind)), body)
        for target in ("/api/settings", "/api/choices", "/")
        for kind in SIMPLE
        for body in (CHOICES, b"choices=x", FORM % b"x.ini")
    ],
    "a path out of the folder": [
        *[Try("GET", target, body=b"") for target in OUTSIDE],
        *[Try("HEAD", target, body=b"") for target in OUTSIDE],
        *[Try(body=chosen(settings=name)) for name in NAMES],
        *[Try(body=chosen(marks=[name])) for name in NAMES],
        *[
            Try("POST", "/api/settings", (("Content-Type", BOUNDARY),), FORM % name.encode())
            for name in NAMES
        ],
    ],
    "a method that the route does not have": [
        Try(method, target)
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "PROPFIND", "X")
        for target in ("/", "/lab.js", "/api/project", "/api/nothing", "/openapi.json")
    ],
    "odd headers": list(odd_headers()),
    "a body that is no request": [
        Try(body=body)
        for body in (
            b"",
            b"{",
            b"null",
            b"[]",
            b"\xff\xfe",
            b"[" * 100_000,
            b'{"a":' * 50_000,
            chosen(units="cubit"),
            chosen(fineness=float("nan")),
            chosen(known={"x": {"value": float("inf"), "sigma": 1}}),
            chosen(nothing=1),
            b'{"choices": {}, "read": "' + b"x" * 5_000_000 + b'"}',
        )
    ],
}


def answered(lab, sent: bytes) -> bytes:
    """The lab's answer to these bytes, until it is whole or the connection closes."""
    with socket.create_connection(("127.0.0.1", lab.port), 120) as line:
        said = b""
        with suppress(OSError):  # it may refuse before the end; the answer is still there
            line.sendall(sent)
        with suppress(ConnectionResetError):
            head = sent.startswith(b"HEAD")
            while not _whole(said, head) and (piece := line.recv(65_536)):
                said += piece
        return said


def _whole(said: bytes, head: bool) -> bool:
    """Whether an answer is complete; that to HEAD has no body."""
    top, gap, body = said.partition(b"\r\n\r\n")
    for line in top.lower().splitlines():
        if line.startswith(b"content-length:"):
            return bool(gap) and (head or len(body) >= int(line.split(b":")[1]))
    return False


def status(answer: bytes) -> int:
    """The status of an answer; 0 if the lab closed without a word."""
    words = answer.split(b" ", 2)
    return int(words[1]) if len(words) > 1 and words[0].startswith(b"HTTP/") else 0
