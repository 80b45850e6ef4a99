"""The report: the lab's page as a single file, with the answers in it that it would ask for."""

import base64
from collections.abc import Callable, Iterator, Mapping
from hashlib import sha256
from html import escape
from importlib.metadata import version
from pathlib import Path

from pydantic_core import to_json

from plumb.cure.decision import Decision
from plumb.diagnosis.diagnosis import Diagnosis
from plumb.diary.file import Diary
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs
from plumb.lab.background import WarmBoard, sure_board
from plumb.lab.project import Choices
from plumb.lab.routes.bench import covariates_of, draw
from plumb.lab.routes.correction import correction_of
from plumb.lab.routes.diary import diary_answer
from plumb.lab.routes.next import next_answer
from plumb.lab.routes.project import ProjectAnswer, machine_of
from plumb.lab.routes.verdict import Verdict, VerdictAnswer, verdict_of
from plumb.plan import Next
from plumb.words import Heading
from plumb.words.comparison import conclusion, readings_said

PAGE = Path(__file__).parent / "page"
SIGN = "A report of Plumb."  # by which the lab knows its own file
SCRIPTLESS = "The plots need JavaScript."
PACKAGES = ("plumb-maslow", "numpy", "scipy")


def report(
    inputs: Inputs,
    decision: Decision,
    advice: Next,
    *,
    diary: Diary | None,
    command: Callable[[str], str],
) -> bytes:
    """Return the page as a file, with what was decided for a board and what to measure next;
    `command` says how a command is called on this board."""
    verdict = verdict_of(inputs, decision)
    project, about = _project(inputs), _about(inputs, command("report"))
    answers = {
        "project": project,
        "about": about,
        "verdict": VerdictAnswer(share=1, verdict=verdict, command=command("diagnose")),
        "next": next_answer(advice, command("next")),
        "correction": correction_of(inputs, decision, project.choices),
        "diary": diary_answer(diary or Diary(Path(), ()), inputs.unit),
        **dict(_of_bench(inputs, decision.diagnosis, verdict)),
    }
    return _file(answers, title=f"{verdict.title} · {about['title']}", said=verdict.sentence)


def _project(inputs: Inputs) -> ProjectAnswer:
    """Return a project with this board alone; its files may have any name."""
    settings = inputs.settings.file.name if inputs.settings.file else ""
    names = [name for name, _ in _rounds(inputs)]
    return ProjectAnswer(
        folder="",
        key="",
        files={},
        choices=Choices.model_construct(settings=settings, marks=names, units=inputs.unit.name),
        choices_digest="",
        machine=machine_of(inputs.settings, settings, inputs.unit),
        trouble="",
        heading=Heading("", ""),
        lacks=("", ""),
        stale=None,
    )


def _of_bench(
    inputs: Inputs, diagnosis: Diagnosis, verdict: Verdict
) -> Iterator[tuple[str, object]]:
    """Yield what errors may depend on, and what each suspect draws."""
    live = sure_board(inputs, diagnosis)
    warm = WarmBoard.of(inputs, live, diagnosis.outliers)
    yield "bench", {"board": "", "covariates": covariates_of(warm)}
    for card in verdict.cards if verdict.marks else ():
        names = list(card.account.effects)
        if names:
            yield f"bench/drawn?{'&'.join(f'effects={name}' for name in names)}", draw(names, warm)


def _about(inputs: Inputs, command: str) -> dict[str, object]:
    """Return what the report is of, and where all of it is from."""
    files = [("settings", inputs.settings.file)]
    if inputs.cut_with:
        files.append(("cut with", inputs.cut_with.file))
    said = [(what, file.name, file.sha256) for what, file in files if file]
    said += [("marks", name, digest) for name, digest in _rounds(inputs)]
    names = " and ".join(name for what, name, _ in said if what == "marks")
    return {
        "title": f"{said[0][1]} with {names}",
        "said": readings_said(inputs),
        "files": [dict(zip(("what", "name", "digest"), each, strict=True)) for each in said],
        "versions": ", ".join(f"{name} {version(name)}" for name in PACKAGES),
        "command": command,
        "compared": conclusion(compare(inputs), inputs.unit),
    }


def _rounds(inputs: Inputs) -> list[tuple[str, str]]:
    """Return the name and the digest of each file of readings."""
    source = Path(inputs.measurements.source).name
    return [(part.name or source, part.digest) for part in inputs.measurements.rounds]


def _file(answers: Mapping[str, object], *, title: str, said: str) -> bytes:
    """Return the page with its answers: it asks no server, and runs no script but its own."""
    script = (PAGE / "lab.js").read_text("utf-8").replace("</script", "<\\/script")
    style = (PAGE / "index.css").read_text("utf-8")
    own = base64.b64encode(sha256(script.encode()).digest()).decode()
    policy = (
        f"default-src 'none'; script-src 'sha256-{own}'; style-src 'unsafe-inline'; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )
    # A name from a file may hold the end of a script; as text of JSON it has no such sign.
    data = to_json(answers).decode().replace("<", "\\u003c")
    return f"""<!doctype html>
<!-- {SIGN} -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body>
<div id="lab"></div>
<noscript><p>{escape(said)}</p><p>{SCRIPTLESS}</p></noscript>
<script type="application/json" id="answers">{data}</script>
<script type="module">{script}</script>
</body>
</html>
""".encode()
