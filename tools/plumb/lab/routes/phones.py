"""Phones as a second pair of hands: how the next is paired, which there are, what they may do."""

from typing import Annotated, Literal

from fastapi import APIRouter, Body, Depends, Request, Response
from pydantic import BaseModel, Field

from plumb.lab.phones import COOKIE, Invitation, Phone, Phones
from plumb.lab.routes.project import of_lab

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
