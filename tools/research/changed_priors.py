"""What the answers hang on: boards of the gates diagnosed again with a prior changed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import ModuleType

import gate_records
from gate_rates import MEASURES, rate_of
from gate_records import Record, record_of
from plumb.diagnosis import Inputs, posterior, priors
from plumb.fit.problem import PRIORS
from plumb.marks.read import Measurements
from plumb.settings.machine import MachineSettings
from tables import markdown_table

SEED = 27002
# The rates that are shown, each over boards of two kinds of which no cure is measured.
RATES = (
    ("nothing hidden, an effect named, 15 marks", "invented", "none-15"),
    ("one effect, best exact, 25 marks", "exact", "other-typical-25"),
    ("a field of 2 mm flagged, 9 marks", "flagged", "field-9"),
    ("a known board called strange, 15 marks", "strange", "none-15"),
)
WORLDS = ("known", "stock")


@dataclass(frozen=True)
class Change:
    """Another prior: names of a module with other values, or other spreads of the frame."""

    what: str
    module: ModuleType = priors
    values: Mapping[str, float] = field(default_factory=dict)
    frame: float = 1.0


CHANGES = (
    Change("as it is"),
    Change("`ACTS` doubled", values={"ACTS": 2 * priors.ACTS}),
    Change("`ACTS` halved", values={"ACTS": priors.ACTS / 2}),
    Change("the frame's spreads halved", frame=0.5),
    Change("`STATED_SPREAD` doubled", values={"STATED_SPREAD": 2 * priors.STATED_SPREAD}),
    Change("`FIELD` a third", module=posterior, values={"FIELD": priors.FIELD / 3}),
)


@contextmanager
def changed(change: Change) -> Iterator[None]:
    """Believe something else for a while."""
    frame = {name: change.frame * spread for name, spread in PRIORS.items()}

    def inputs(settings: MachineSettings, measurements: Measurements) -> Inputs:
        return Inputs(settings, measurements, priors=frame)

    believed, asked = vars(change.module), vars(gate_records)
    kept = {name: believed[name] for name in change.values}
    try:
        believed.update(change.values)
        asked["Inputs"] = inputs
        yield
    finally:
        believed.update(kept)
        asked["Inputs"] = Inputs


def priors_section(boards: int) -> str:
    """Return a table of rates by changed priors, over a number of boards of each kind."""
    kinds = dict.fromkeys(f"{world}/{kind}" for *_, kind in RATES for world in WORLDS)
    rows = []
    for change in CHANGES:
        with changed(change):
            records = [
                Record.of(record_of(kind, index, seed=SEED))
                for kind in kinds
                for index in range(boards)
            ]
        rows.append([change.what, *(_cell(records, *rate) for rate in RATES)])
    header = ("prior", *(what for what, *_ in RATES))
    table = markdown_table(header, rows)
    count = len(WORLDS) * boards
    return f"Percent of {count} boards, half of them on stock settings, seed {SEED}.\n\n{table}"


def _cell(records: Sequence[Record], _: str, measure: str, kind: str) -> str:
    several = [record for record in records if record.kind.endswith(f"/{kind}")]
    rate = rate_of(MEASURES[measure], several)
    assert rate, "every kind has its boards"
    return f"{100 * rate.value:.0f} +- {100 * rate.error:.0f}"
