"""What belongs to the client that was named, and what the owner does with it."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import computed_field

from plumb.cli.arguments import file
from plumb.cli.screen import sentences, table
from plumb.firmware.client_files import CLIENT_FILES, ClientFiles, client_files
from plumb.settings.machine import CLIENTS, FIRMWARES, MachineSettings
from plumb.text.answers import Internal
from plumb.text.errors import InputError


def client_files_of(
    arguments: argparse.Namespace,
    settings: MachineSettings,
    *,
    lines: str | None,
    firmware: str = "plumb",
    originals: Sequence[str | None] = (),
) -> ClientFiles | None:
    """Return the lines for the machine, and what belongs to the client; None if no client was
    named.
    """
    if arguments.original and arguments.client not in CLIENT_FILES:
        raise InputError("--original is the file of a client; name the client too, with --client")
    if arguments.client is None:
        return None
    if not lines:
        raise InputError("--client writes several files; name the first with -o FILE")
    ending = Path(CLIENT_FILES.get(arguments.client, "")).suffix or None
    given = [path for path in originals if path and ending and path.lower().endswith(ending)]
    return client_files(
        settings,
        client=arguments.client,
        firmware=firmware,
        original=arguments.original or next(iter(given), None),
        lines=lines,
    )


def client_text(files: ClientFiles) -> str:
    """Return what the owner does with the files, for people."""
    parts = [sentences([f"{step[0].upper()}{step[1:]}." for step in files.steps])]
    if files.typed:
        rows = [[section, key, value] for (section, key), value in files.typed.items()]
        parts.append(table(["section", "key", "value"], rows, left=2))
    if files.unsaid:
        parts.append("What the published firmware cannot do:\n" + sentences(files.unsaid))
    return "\n\n".join(parts)


def typed_json(files: ClientFiles | None) -> dict[str, str]:
    """Return what the owner types into the client, by section and key."""
    typed = files.typed if files else {}
    return {f"{section}: {key}": value for (section, key), value in typed.items()}


@dataclass(frozen=True, kw_only=True)
class Written:
    """The files that were written, and what the owner does with them."""

    written: tuple[str, ...]
    client: Internal[ClientFiles | None]

    @computed_field
    @property
    def steps(self) -> tuple[str, ...]:
        """What the owner does with the files, a sentence each."""
        return self.client.steps if self.client else ()

    @computed_field
    @property
    def typed(self) -> dict[str, str]:
        """What the owner types into the client, by `section: key`."""
        return typed_json(self.client)


# The options that name the client and the firmware that files are for.


def add_client(parser: argparse.ArgumentParser) -> None:
    """Add the options --client and --original."""
    parser.add_argument(
        "--client",
        choices=CLIENTS,
        help="the program that sends G-code to the machine. It stores numbers too, and sends them "
        "each time it connects. none: a sender that stores no numbers",
    )
    parser.add_argument(
        "--original",
        metavar="INI",
        type=file,
        help="the client's groundcontrol.ini or webcontrol.json; its other keys stay as they are",
    )


def add_firmware(parser: argparse.ArgumentParser) -> None:
    """Add the option --firmware."""
    parser.add_argument(
        "--firmware",
        choices=FIRMWARES,
        default="plumb",
        help="which firmware the machine runs; with the published firmware the client carries all "
        "corrections [%(default)s]",
    )
