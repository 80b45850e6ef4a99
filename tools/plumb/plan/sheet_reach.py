"""The part of a sheet that a machine can use, and how far off is normal there: one answer."""

from collections.abc import Mapping
from dataclasses import dataclass

from plumb.fit.expected import Expected, expected_anywhere, expected_priors, expected_sentence
from plumb.model.predict import REACH_WORDS
from plumb.model.reach import Extreme, Survey, conclusion_of, percent, survey_sheet
from plumb.settings.machine import MachineSettings
from plumb.text.answers import Internal, in_json, part
from plumb.text.values import MM, Unit

SIGNS = ".TSV#"  # by verdict
MEANING = (
    "usable",
    "too tight: a chain pulls more than its gearbox should",
    "too slack: a chain pulls less than its gears need to lie on one side",
    "too vertical: only a slack chain holds the sled, which gives sideways",
    "no sled hangs there, or its ring touches a sprocket",
)
MAP_STEP = 4  # every fourth place of the survey


@dataclass(frozen=True)
class Share:
    """A share of the sheet, and what is to be said of it."""

    sign: str  # on the map
    share: str
    meaning: str


@dataclass(frozen=True, kw_only=True)
class SheetReach:
    """The usable part of the sheet, and what limits the rest."""

    survey: Internal[Survey]
    expected: Expected | None  # None: no sled hangs on this sheet
    unit: Internal[Unit] = MM  # of the lengths in what is said of it

    extremes = part("survey.extremes", tuple[Extreme, ...])
    assumed = part("survey.assumed", tuple[str, ...], "What the settings do not say.")

    @in_json
    def conclusion(self) -> str:
        """The usable part in a sentence."""
        return conclusion_of(self.survey)

    @in_json
    def normal(self) -> str:
        """The expected error in sentences; empty if no mark can be made."""
        return expected_sentence(self.expected, self.unit)

    @in_json
    def shares(self) -> dict[str, float]:
        """The share of the sheet of each verdict."""
        return {word.replace(" ", "_"): share for word, share in self.survey.shares.items()}

    @in_json
    def legend(self) -> list[Share]:
        """The verdicts that the map has."""
        each = zip(SIGNS, map(self.survey.shares.get, REACH_WORDS), MEANING, strict=True)
        return [Share(sign, percent(share), meaning) for sign, share, meaning in each if share]

    @in_json
    def map(self) -> list[str]:
        """The sheet in characters, from the top down; edges included."""
        rows = self.survey.reached.verdict.reshape(len(self.survey.y), len(self.survey.x))
        return ["".join(SIGNS[each] for each in row) for row in rows[::MAP_STEP, ::MAP_STEP]]


def reach_of(
    settings: MachineSettings, known: Mapping[str, float]
) -> tuple[Survey, Expected | None]:
    """Return what a SheetReach is made of; `known`: how far stated numbers may be off."""
    return survey_sheet(settings), expected_anywhere(settings, expected_priors(known))
