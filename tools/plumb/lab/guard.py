"""Lets in only the page that this server handed out, before any route sees a request.

Any web site can make a browser send requests to this computer. So a request must name this server
as its host and come from no other site. Only the page's files can be had without the token, which
is a part of the URL that `plumb lab` prints. A phone has no token: it names the address at which
it found this computer, and its cookie holds the key that it got for the PIN.
"""

import asyncio
import hmac
import re
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from plumb.lab.routes.phones import BY_HAND, COOKIE, PAIR, Phones, may_ask

LARGEST_BODY = 6_000_000  # bytes; a file of marks may have five million
LARGEST_HEADER = 16_384  # bytes, all of them together
BODY_S = 20.0  # within which the whole body is here: it comes from this computer
TOKEN_HEADER = "x-plumb-token"
PROTOCOL = "plumb"  # of the websocket; the token follows it in the same header
SAFE = ("GET", "HEAD")
PAGE_FILE = re.compile(r"/[\w./-]*")  # Python 3.11.3 finds x for x%00y
MOST_LIVE = 12  # live lines at a time, of which each tab has one
CLOSED = 1008  # websocket: the policy refuses


@dataclass(frozen=True)
class Address:
    """Where the server listens."""

    host: str
    port: int

    def hosts(self, scope: Scope) -> tuple[str, ...]:
        """Return what a browser may name as the host: for a phone, the address to which it is
        connected, as a number; a name could be anybody's.
        """
        if self.is_phone(scope):
            return (f"{scope['server'][0]}:{self.port}",)
        return (f"{self.host}:{self.port}", f"localhost:{self.port}")

    def is_phone(self, scope: Scope) -> bool:
        """Return whether a request came to another address of this computer: by the network."""
        return str(scope["server"][0]) != self.host


class Refusal(JSONResponse):
    """An answer that ends the connection: what else the client sends is not waited for."""

    def __init__(self, status: int, reason: str) -> None:
        super().__init__({"error": reason}, status, {"connection": "close"})
        self.reason = reason


class Guard:
    """Refuses what does not come from our page; adds the headers that bind the page."""

    def __init__(self, app: ASGIApp, *, address: Address, token: str, phones: Phones) -> None:
        self.app, self.address, self.token, self.phones = app, address, token, phones
        self.live = 0  # live lines that are open

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        send = self._bound(send, scope) if scope["type"] == "http" else send
        refusal = self._refusal(scope)
        if not refusal and scope["type"] == "http" and scope["method"] not in SAFE:
            receive, refusal = await _received(receive)
        if not refusal:
            await self._served(scope, receive, send)
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": CLOSED, "reason": refusal.reason})
        else:
            await refusal(scope, receive, send)

    async def _served(self, scope: Scope, receive: Receive, send: Send) -> None:
        live = scope["type"] == "websocket"
        self.live += live
        try:
            await self.app(scope, receive, send)
        finally:
            self.live -= live

    def _refusal(self, scope: Scope) -> Refusal | None:
        """Return the answer to a request that is not for us."""
        headers = Headers(scope=scope)
        hosts = self.address.hosts(scope)
        if sum(len(name) + len(value) for name, value in headers.raw) > LARGEST_HEADER:
            return Refusal(431, "the headers are too large")
        if headers.getlist("host") not in [[host] for host in hosts]:
            return Refusal(403, "this server answers to its own address only")
        origins = [f"http://{host}" for host in hosts]
        if any(origin not in origins for origin in headers.getlist("origin")):
            return Refusal(403, "this request comes from another site")
        if scope["type"] == "http" and not scope["path"].startswith("/api/"):
            if scope["method"] not in SAFE:
                return Refusal(405, "the page's files are only read")
            known = PAGE_FILE.fullmatch(scope["path"])
            return None if known else Refusal(404, "the page has no such file")
        if headers.get("sec-fetch-site", "none") not in ("same-origin", "none"):
            return Refusal(403, "this request comes from another site")
        if refusal := self._without_key(scope, headers):
            return refusal
        if scope["type"] == "websocket" and self.live >= MOST_LIVE:
            return Refusal(503, "too many tabs are open")
        declared = headers.get("content-length", "0")
        if not declared.isascii() or not declared.isdigit():
            return Refusal(400, "content-length is not a number")
        return _too_large() if int(declared) > LARGEST_BODY else None

    def _without_key(self, scope: Scope, headers: Headers) -> Refusal | None:
        """Return the answer to who has no key, or not the key for this."""
        if not self.address.is_phone(scope):
            knows = self._knows_token(scope, headers)
            line = "open the lab by the address that plumb lab printed: it holds the key"
            return None if knows else Refusal(403, line)
        method = scope.get("method", "GET")
        if (method, scope["path"]) == ("POST", PAIR):
            return None
        scope["key"] = _cookie(headers)
        scope["phone"] = phone = self.phones.of(scope["key"])
        if phone is None:
            return Refusal(401, "this phone is not paired: scan the code on the computer")
        if not may_ask(phone, method, scope["path"]):
            return Refusal(403, f"this phone may {BY_HAND}; allow more on the computer")
        return None

    def _knows_token(self, scope: Scope, headers: Headers) -> bool:
        given = headers.get(TOKEN_HEADER, "")
        if scope["type"] == "websocket":
            words = [word.strip() for word in headers.get("sec-websocket-protocol", "").split(",")]
            given = words[1] if len(words) == 2 and words[0] == PROTOCOL else ""
        return hmac.compare_digest(given.encode(), self.token.encode())

    def _bound(self, send: Send, scope: Scope) -> Send:
        """Send each answer with the headers that keep other sites and foreign scripts out."""
        sockets = " ".join(f"ws://{host}" for host in self.address.hosts(scope))
        policy = (
            "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
            f"font-src 'self'; connect-src 'self' {sockets}; base-uri 'none'; form-action 'none'; "
            "frame-ancestors 'none'"
        )

        async def sending(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["content-security-policy"] = policy
                headers["x-content-type-options"] = "nosniff"
                headers["referrer-policy"] = "no-referrer"
                headers["cross-origin-resource-policy"] = "same-origin"
                headers["cross-origin-opener-policy"] = "same-origin"
                headers.setdefault("cache-control", "no-store")
            await send(message)

        return sending


def _cookie(headers: Headers) -> str:
    """Return the key in the cookie of a phone; empty if there is none."""
    try:
        kept = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
    except CookieError:
        return ""
    return kept.value if kept else ""


def _too_large() -> Refusal:
    return Refusal(413, f"is larger than {LARGEST_BODY // 1_000_000} MB")


async def _received(receive: Receive) -> tuple[Receive, Refusal | None]:
    """Return the whole body, to be received at once, if it has the size and the haste of our
    page's.
    """
    body = bytearray()
    try:
        async with asyncio.timeout(BODY_S):
            more = True
            while more:
                message = await receive()
                if message["type"] == "http.disconnect":
                    return receive, Refusal(400, "the request ended in the middle")
                body += message.get("body", b"")
                more = message.get("more_body", False)
                if len(body) > LARGEST_BODY:
                    return receive, _too_large()
    except TimeoutError:
        return receive, Refusal(408, f"did not arrive within {BODY_S:.0f} s")
    return _replayed(bytes(body), receive), None


def _replayed(body: bytes, receive: Receive) -> Callable[[], Awaitable[Message]]:
    """Receives a body that is here already, and then what comes after it."""
    messages = [{"type": "http.request", "body": body, "more_body": False}]

    async def receiving() -> Message:
        return messages.pop() if messages else await receive()

    return receiving
