"""Answer of a command: a dataclass, from which its JSON and the schema follow.

`key` names a field for the JSON where another name says more there. An `Internal` field stays out
of it, and so does a property without `computed_field`.
"""

import math
from collections.abc import Mapping, Sequence
from datetime import datetime
from operator import attrgetter
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeVar

import numpy as np
from pydantic import (
    BaseModel,
    Field,
    GetPydanticSchema,
    PlainSerializer,
    TypeAdapter,
    computed_field,
)
from pydantic.fields import FieldInfo
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema

T = TypeVar("T")
Internal = Annotated[
    T, Field(exclude=True), GetPydanticSchema(lambda _type, _handler: core_schema.any_schema())
]
# A number that is null in the JSON where it is not finite.
Number = Annotated[float, PlainSerializer(lambda number: plain(number), return_type=float | None)]
# A time of day as ISO 8601 writes it.
Moment = Annotated[datetime, PlainSerializer(datetime.isoformat, return_type=str)]


def key(name: str, said: str | None = None) -> Any:
    """Return the name of a field in the JSON, and what the schema says of it."""
    info: FieldInfo = Field(serialization_alias=name, description=said)
    return info


def meant(description: str) -> Any:
    """Return what the schema says of a field."""
    info: FieldInfo = Field(description=description)
    return info


def among(words: Sequence[str | None]) -> Any:
    """Return a text that is one of these words."""
    info: FieldInfo = Field(json_schema_extra={"enum": list(words)})
    return info


def part(path: str, kind: Any, said: str | None = None, *, name: str | None = None) -> Any:
    """Another key of the JSON: what is at this path of attributes, and its type."""
    value = attrgetter(path)
    made = computed_field(alias=name, return_type=kind, description=said)
    return made(property(lambda each: value(each)))


# A property that the JSON has too; a type checker sees a property.
if TYPE_CHECKING:
    in_json = property
else:
    in_json = computed_field

Answer = TypeVar("Answer", bound=BaseModel)


def like(kind: type[Answer], other: object, **more: Any) -> Answer:
    """Return an answer with what `other` has of the same names, and more."""
    names = kind.model_fields.keys() - more.keys()
    has = (
        other if isinstance(other, Mapping) else {name: getattr(other, name, ...) for name in names}
    )
    same = {name: has[name] for name in names & has.keys() if has[name] is not ...}
    return kind(**same, **more)


def json_of(answer: object) -> Any:
    """Return the answer in the types of JSON, by the names of the interface."""
    return plain(TypeAdapter(type(answer)).dump_python(answer, by_alias=True))


def plain(value: Any) -> Any:
    """Return the value in the types of JSON; what is not a finite number is null."""
    if isinstance(value, Mapping):
        return {str(name): plain(item) for name, item in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def schema_of(types: Mapping[str, Any]) -> dict[str, Any]:
    """Return the JSON schema of these answers by the names of their commands; no key is ever
    missing.
    """
    wanted: list[tuple[str, Literal["serialization"], TypeAdapter[Any]]] = [
        (name, "serialization", TypeAdapter(kind)) for name, kind in types.items()
    ]
    tops, shared = TypeAdapter.json_schemas(
        wanted, by_alias=True, ref_template="#/$defs/{model}", schema_generator=_WithoutTitles
    )
    parts = dict(shared.get("$defs", {}))
    parts |= {name: tops[name, "serialization"] for name in types}
    for each in parts.values():
        if "properties" in each:
            each |= {"required": list(each["properties"]), "additionalProperties": False}
    return parts


class _WithoutTitles(GenerateJsonSchema):
    """A title repeats the name that a field or an answer has already."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        """Never."""
        return False
