"""Phones that are paired with the lab: a second pair of hands, as far as the computer lets them.

A phone on the same network shows the page. With the PIN that terminal and page show it is paired,
until the lab ends or somebody sends it away: it looks, it types readings, it holds and stops. It
does all the rest only if the computer lets it.
"""

import io
import re
import secrets
import socket
from collections.abc import Callable
from dataclasses import dataclass, replace
from threading import Lock
from time import monotonic
from typing import Annotated, Literal

import segno
from fastapi import APIRouter, Body, Depends, Request, Response
from pydantic import BaseModel, Field

from plumb.lab.routes.project import of_lab
from plumb.text.answers import in_json
from plumb.text.errors import InputError
from plumb.words import machine as words

Sharing = Literal["no", "hands", "move"]
COOKIE = "plumb-phone"  # holds the key of a phone
MOST_PHONES = 8
TRIES = 5  # wrong PINs, after which the PIN is another
WAIT_S = 60.0  # until the next try after these
FAR = ("192.0.2.1", 9)  # an unused address: the route to it shows this computer's own address
# What every phone may change; a question changes nothing.
HANDS = re.compile(r"PUT /api/(readings|distances)|POST /api/machine/(hold|stop)")
BY_HAND = "look, type readings, hold and stop"  # the same in words
PAIR, ME = "/api/phones/pair", "/api/phones/me"  # all else of phones is the computer's


@dataclass(frozen=True)
class Phone:
    """A paired phone."""

    number: int
    name: str
    may_move: bool

    @in_json
    def may(self) -> str:
        """What it may do, in words."""
        return "may also move the machine" if self.may_move else f"may {BY_HAND}"


@dataclass(frozen=True)
class Invitation:
    """The code that pairs the next phone."""

    address: str  # for its browser; empty: this computer is in no network
    pin: str

    @property
    def link(self) -> str:
        """The address with the PIN, which no server sees: it stands behind the #."""
        return f"{self.address}#/pair/{self.pin}"

    @in_json
    def picture(self) -> str:
        """The link as a QR code, as the source of an image; empty without a network."""
        return segno.make(self.link, error="m").svg_data_uri(light="white") if self.address else ""

    @property
    def text(self) -> str:
        """The same for a terminal."""
        drawn = io.StringIO()
        if self.address:
            segno.make(self.link, error="l").terminal(drawn, border=2, compact=True)
        return drawn.getvalue() + words.how_to_pair(self.address, self.pin)


class Phones:
    """All phones of a lab, and the PIN for the next."""

    def __init__(
        self, sharing: Sharing = "no", *, port: int = 0, say: Callable[[str], None] = print
    ) -> None:
        """Share the lab that listens on this port; `say` shows each new invitation."""
        self.sharing, self._port, self._say = sharing, port, say
        self._lock = Lock()
        self._paired: dict[str, Phone] = {}  # by its key
        self._count = 0
        self._wrong = 0  # PINs since the last right one
        self._waits_until = 0.0
        self._renew()

    @property
    def invitation(self) -> Invitation:
        """The code that pairs the next phone; the network may have changed."""
        host = _own_address()
        return Invitation(f"http://{host}:{self._port}/" if host else "", self._pin)

    @property
    def paired(self) -> list[Phone]:
        """The phones, the earliest first."""
        return sorted(self._paired.values(), key=lambda phone: phone.number)

    def of(self, key: str) -> Phone | None:
        """Return the phone with a key; None if it was never paired, or sent away."""
        return self._paired.get(key)

    def pair(self, pin: str, kind: str) -> tuple[str, Phone]:
        """Return the key of a new phone of some kind, and the phone. Raises InputError."""
        with self._lock:
            left = self._waits_until - monotonic()
            if left > 0:
                raise InputError(f"too many wrong PINs: wait {left:.0f} seconds, then take the new")
            if not secrets.compare_digest(pin.encode(), self._pin.encode()):
                self._refuse()
            if len(self._paired) >= MOST_PHONES:
                raise InputError(f"{MOST_PHONES} phones are paired: send one away first")
            self._count += 1
            phone = Phone(self._count, f"{kind} {self._count}", self.sharing == "move")
            key = secrets.token_urlsafe(32)
            self._paired[key] = phone
            self._renew()  # who photographed the code cannot use it again
        return key, phone

    def _refuse(self) -> None:
        self._wrong += 1
        if self._wrong < TRIES:
            raise InputError("this is not the PIN; look at the computer, or scan the code there")
        self._waits_until = monotonic() + WAIT_S
        self._renew()
        raise InputError(f"this is not the PIN, {TRIES} times: there is a new one in a minute")

    def _renew(self) -> None:
        self._pin, self._wrong = f"{secrets.randbelow(10**6):06d}", 0
        if self.sharing != "no":
            self._say(self.invitation.text)

    def let(self, number: int, *, may_move: bool) -> None:
        """Let a phone move the machine and change all else, or no longer."""
        with self._lock:
            key = self._key(number)
            self._paired[key] = replace(self._paired[key], may_move=may_move)

    def send_away(self, number: int) -> None:
        """Forget a phone: its key opens nothing from now on."""
        with self._lock:
            del self._paired[self._key(number)]

    def _key(self, number: int) -> str:
        for key, phone in self._paired.items():
            if phone.number == number:
                return key
        raise InputError("this phone is not paired any more")


def may_ask(phone: Phone, method: str, path: str) -> bool:
    """Return whether a phone may ask for this."""
    if path.startswith("/api/phones") and path != ME:
        return False
    changes = method not in ("GET", "HEAD")
    return phone.may_move or not changes or bool(HANDS.fullmatch(f"{method} {path}"))


def _own_address() -> str:
    """Return this computer's address in its network; empty if it is in none. Nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(FAR)
        except OSError:
            return ""
        return str(probe.getsockname()[0])


# What the page asks of them.


router = APIRouter(tags=["phones"])


class PhonesAnswer(BaseModel):
    """The phones of this lab."""

    invitation: Invitation | None  # None: the lab is not shared
    phones: list[Phone]


class Pairing(BaseModel):
    """Request of a phone to be paired."""

    pin: str = Field(max_length=12)
    kind: Literal["iPhone", "iPad", "Android", "phone"] = "phone"


ThePhones = Annotated[Phones, Depends(of_lab("phones", Phones))]


@router.get("/phones")
def show_phones(phones: ThePhones) -> PhonesAnswer:
    """Return the phones, and how to pair another."""
    shared = phones.sharing != "no"
    return PhonesAnswer(invitation=phones.invitation if shared else None, phones=phones.paired)


@router.post("/phones/pair")
def pair(asked: Pairing, phones: ThePhones, response: Response) -> Phone:
    """Pair the phone that asks: its browser gets a key of its own."""
    key, phone = phones.pair(asked.pin, asked.kind)
    response.set_cookie(COOKIE, key, httponly=True, samesite="strict")
    return phone


@router.get("/phones/me")
def who_asks(request: Request) -> Phone | None:
    """Return the phone that asks; None for the computer itself."""
    phone: Phone | None = request.scope.get("phone")
    return phone


@router.post("/phones/{number}/let")
def let(
    number: int, may_move: Annotated[bool, Body(embed=True)], phones: ThePhones
) -> PhonesAnswer:
    """Let a phone move the machine, or no longer."""
    phones.let(number, may_move=may_move)
    return show_phones(phones)


@router.post("/phones/{number}/send-away")
def send_away(number: int, phones: ThePhones) -> PhonesAnswer:
    """Send a phone away."""
    phones.send_away(number)
    return show_phones(phones)
