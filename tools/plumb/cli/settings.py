"""`plumb settings`: a fitted machine as lines for our firmware, with what its client needs."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from plumb.cli.arguments import add_shared, file
from plumb.cli.output import write_outputs
from plumb.cli.screen import headline, next_step, print_json, sentences, table
from plumb.firmware.settings import (
    CLIENT_FILES,
    ClientFiles,
    SentSetting,
    client_files,
    firmware_numbers,
)
from plumb.fit.inputs import settings_in
from plumb.settings import CLIENTS, FIRMWARES, MachineSettings
from plumb.text.answers import Internal, in_json, meant
from plumb.text.errors import InputError


@dataclass(frozen=True)
class SettingLines:
    """A machine as its firmware holds it."""

    settings: tuple[SentSetting, ...]
    written: tuple[str, ...]
    typed: Annotated[
        dict[str, str], meant("What the owner types into the client, by `section: key`.")
    ]


def run(arguments: argparse.Namespace) -> int:
    """Convert, write or print, and return the exit code."""
    settings = settings_in(arguments.settings)
    if settings.controller != "plumb":
        raise InputError(
            arguments.settings,
            "holds the published numbers, which GroundControl or WebControl sends",
            remedy="give a machine.toml that plumb add wrote for our firmware",
        )
    numbers = firmware_numbers(settings)
    client = _written_for_client(arguments, settings)
    if arguments.json:
        print_json(SettingLines(numbers, tuple(client.files if client else ()), typed_json(client)))
    elif client:
        print(f"Written: {', '.join(client.files)}")
        print(client_text(client))
    else:
        shown = numbers if arguments.details else _at_work(numbers)[:MOST]
        rows = [[f"${row.number}", row.name, row.text, row.unit] for row in shown]
        print(table(["number", "name", "value", "unit"], rows, left=2, words=[-1]))
        print(f"\n{headline(_verdict(numbers, shown))}")
        kept = ["--client", "groundcontrol", "--original", "groundcontrol.ini"]
        words = ["settings", arguments.settings, *kept, "-o", "machine.nc"]
        print(f"\n{next_step('For the machine:', words)}")
    return 0


def _written_for_client(
    arguments: argparse.Namespace, settings: MachineSettings
) -> ClientFiles | None:
    """Write the lines and the client's files, if they are asked for. A client that carries some
    corrections too would double them, so lines alone are refused.
    """
    if arguments.output and arguments.client is None:
        raise InputError(
            "-o needs --client: GroundControl and WebControl send their own corrections each time "
            "they connect, and the machine would apply them twice; give --client groundcontrol "
            "--original groundcontrol.ini, --client webcontrol, or --client none"
        )
    client = client_files_of(arguments.client, arguments.original, settings, lines=arguments.output)
    if client:
        read = [arguments.settings, *filter(None, [arguments.original])]
        write_outputs(client.files, inputs=read)
    return client


MOST = 16  # rows of a short answer


def _at_work(numbers: tuple[SentSetting, ...]) -> tuple[SentSetting, ...]:
    """Return the numbers that are not 0."""
    return tuple(row for row in numbers if float(row.text) != 0)


def _verdict(numbers: tuple[SentSetting, ...], shown: tuple[SentSetting, ...]) -> str:
    count = len(_at_work(numbers))
    said = f"{count} numbers make this machine, {len(numbers) - count} are 0."
    return said if len(shown) == len(numbers) else f"{said} --details shows all."


# The arguments of `plumb settings`.

EXAMPLES = (
    "plumb settings machine.toml",
    "plumb settings machine.toml --client webcontrol -o machine.nc",
)
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb settings`."""
    add_shared(parser, "settings")
    add_client(parser)
    add_shared(
        parser, output="write the numbers as lines for the machine, and what belongs to the client"
    )
    add_shared(parser, details="the numbers that are 0")
    add_shared(parser, "--force", "--json")


# What belongs to the client that was named, and what the owner does with it.


def client_files_of(
    client: str | None,
    original: str | None,
    settings: MachineSettings,
    *,
    lines: str | None,
    firmware: str = "plumb",
    originals: Sequence[str] = (),
) -> ClientFiles | None:
    """Return the lines for the machine, and what belongs to the client; None if no client was
    named.
    """
    if original and client not in CLIENT_FILES:
        raise InputError("--original is the file of a client; name the client too, with --client")
    if client is None:
        return None
    if not lines:
        raise InputError("--client writes several files; name the first with -o FILE")
    ending = Path(CLIENT_FILES.get(client, "")).suffix or None
    given = [path for path in originals if ending and path.lower().endswith(ending)]
    return client_files(
        settings,
        client=client,
        firmware=firmware,
        original=original or next(iter(given), None),
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
class WrittenFiles:
    """The files that were written, and what the owner does with them."""

    written: tuple[str, ...] = ()
    client: Internal[ClientFiles | None] = None

    @in_json
    def steps(self) -> tuple[str, ...]:
        """Steps of the owner with the files, a sentence each."""
        return self.client.steps if self.client else ()

    @in_json
    def typed(self) -> dict[str, str]:
        """Values to type into the client, by `section: key`."""
        return typed_json(self.client)

    @in_json
    def unsaid(self) -> tuple[str, ...]:
        """Limits of the firmware, a sentence each."""
        return self.client.unsaid if self.client else ()


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
