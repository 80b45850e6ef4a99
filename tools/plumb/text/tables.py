"""Files as tables of fields: a model says what a table may hold, and anything else is refused.

A refusal is a line that says where, what, and what to write:
`machine.toml, [frame]: motor_gap is missing; write motor_gap = ... (mm between sprocket centres)`.
"""

from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin

import tomlkit
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import ErrorDetails

from plumb.text.errors import InputError, Source
from plumb.text.values import number, refuse_unknown, shortened

KeyPath = tuple[int | str, ...]  # of a value: the names of tables and keys, and numbers in lists
Number = Annotated[float, BeforeValidator(number)]


def refuse_other_keys(kind: Any, said: Any) -> Any:
    """Return a table as it is, if all its keys are fields, and none is missing."""
    fields = kind.__pydantic_fields__ if isinstance(said, Mapping) else {}
    if fields:
        refuse_unknown(said, fields)
    for key, field in fields.items():
        if field.is_required() and key not in said:
            words = get_args(field.annotation) if get_origin(field.annotation) is Literal else ()
            choice = " or ".join(f'{key} = "{word}"' for word in words)
            meaning = f" ({field.description})" if field.description else ""
            raise ValueError(f"{key} is missing; write {choice or f'{key} = ...{meaning}'}")
    return said


class Table(BaseModel):
    """A table of a file, whose keys are the fields; `meant` says what a number is, and its unit."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _refuse_other_keys(cls, said: Any) -> Any:
        return refuse_other_keys(cls, said)


def part() -> Any:
    """Return a table in a table; where it is missing, the first key that it needs is."""
    return Field(default={}, validate_default=True)


Kind = TypeVar("Kind", bound=BaseModel)


def read_table(
    kind: type[Kind],
    said: Mapping[str, Any],
    source: Source,
    *,
    place: Callable[[KeyPath], str] | None = None,
    context: object = None,
) -> Kind:
    """Return what a file says, or raise InputError; `place` names a value, if not as in TOML."""
    try:
        return kind.model_validate(said, context=context)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        where = place(first["loc"]) if place else place_in(said, first["loc"])
        raise InputError(source, refusal(first), place=where) from None


def place_in(said: Mapping[str, Any], path: KeyPath) -> str:
    """Return the table and the key of a value, as a TOML file names them."""
    value: Any = said
    for step in path:
        value = value.get(step, {}) if isinstance(value, Mapping) else value[int(step)]
    names = [step for step in path if isinstance(step, str)]
    key = names.pop() if names and not isinstance(value, Mapping) else ""
    if not names:
        return key
    table = f"[{'.'.join(names)}]"
    if len(names) == 1 and len(path) > 1 and isinstance(path[1], int):
        called = said[names[0]][path[1]].get("name")
        table = f"{names[0]} {called}" if called else f"[{table}] number {path[1] + 1}"
    return f"{table} {key}".strip()


def refusal(error: ErrorDetails) -> str:
    """Return what is wrong with a value, and what to write."""
    kind, value, context = error["type"], error["input"], error.get("ctx", {})
    name = ".".join(step for step in error["loc"] if isinstance(step, str))
    if kind == "value_error":
        return str(context["error"])
    if kind == "literal_error":
        words = context["expected"].replace("'", "").replace(" or ", ", ")
        return f"'{shortened(value)}' is not known; write one of {words}"
    if kind in ("list_type", "tuple_type"):
        if isinstance(value, Mapping):
            return f"needs double brackets; write [[{name}]]"
        return "a list in brackets is needed"
    if kind in ("model_type", "dict_type", "dataclass_type"):
        return f"is not a table; write a line [{name}]"
    if kind == "bool_type":
        return f"'{shortened(value)}' is neither true nor false"
    return "text in quotes is needed" if kind == "string_type" else error["msg"]


# Tables as the text of a TOML file.


def toml_text(tables: Mapping[str, Any], notes: Mapping[str, str | None]) -> str:
    """Return the text of tables; `notes` stand behind values, by the name of the table and key."""
    document = tomlkit.document()
    document.update(tables)
    _note(document, notes, "")
    return document.as_string()


def _note(tables: Any, notes: Mapping[str, str | None], name: str) -> None:
    for key, value in tables.items():
        for each in value if isinstance(value, tomlkit.items.AoT) else [value]:
            if isinstance(each, tomlkit.items.Table):
                _note(each, notes, key)
            elif note := notes.get(f"{name}.{key}"):
                each.comment(note)
                each.trivia.comment_ws = "  "
