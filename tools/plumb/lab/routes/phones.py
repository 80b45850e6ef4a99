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


class PhoneAnswer(BaseModel):
    """Name and rights of the asking browser."""

    name: str  # empty on the computer itself
    may_move: bool


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
def pair(asked: Pairing, phones: ThePhones, response: Response) -> PhoneAnswer:
    """Pair the phone that asks: its browser gets a key of its own."""
    key, phone = phones.pair(asked.pin, asked.kind)
    response.set_cookie(COOKIE, key, httponly=True, samesite="strict")
    return PhoneAnswer(name=phone.name, may_move=phone.may_move)


@router.get("/phones/me")
def who_asks(request: Request) -> PhoneAnswer:
    """Return what the asking browser may do."""
    phone: Phone | None = request.scope.get("phone")
    return PhoneAnswer(name=phone.name if phone else "", may_move=phone.may_move if phone else True)


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
