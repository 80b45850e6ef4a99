"""The types in tools/plumb/_core.pyi and _judge.pyi are those of the compiled modules."""

import ast
from pathlib import Path
from types import ModuleType

import plumb
import pytest
from nanobind.stubgen import StubGen
from plumb import _core, _judge
from plumb.model import effect_words


def stub_of(module: ModuleType) -> str:
    """The types of a compiled module as the tree has them."""
    name = module.__name__.rpartition(".")[2]
    return Path(plumb.__file__).with_name(f"{name}.pyi").read_text()


TYPES = stub_of(_core) + Path(effect_words.__file__).read_text()
RESULTS = {
    "FrameWords": _core.frame()[0],
    "EffectWords": _core.effects()[0],
    "CheckWords": _core.effects()[0]["check"],
    "ExampleWords": _core.effects()[0]["examples"][0],
    "ParameterWords": _core.effects()[0]["parameters"][0],
    "Effective": _core.effective({}),
}
PLAIN = {"int": int, "str": str, "bool": bool, "float": float}


def signatures(text: str) -> dict[str, tuple[list[str], list[str], int]]:
    """Of each function: its parameters, those given by name alone, the count of defaults."""
    functions = [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)]
    return {
        function.name: (
            [parameter.arg for parameter in function.args.args],
            [parameter.arg for parameter in function.args.kwonlyargs],
            len(function.args.defaults) + len(function.args.kw_defaults),
        )
        for function in functions
    }


def fields_of(record: str) -> dict[str, str]:
    """The keys of a TypedDict with their types as written."""
    classes = [node for node in ast.parse(TYPES).body if isinstance(node, ast.ClassDef)]
    fields = next(each.body for each in classes if each.name == record)
    typed = [field for field in fields if isinstance(field, ast.AnnAssign)]
    return {field.target.id: ast.unparse(field.annotation) for field in typed}


@pytest.mark.parametrize("module", [_core, _judge], ids=["core", "judge"])
def test_the_stub_has_the_functions_of_the_module(module):
    generated = StubGen(module)
    generated.put(module)
    assert signatures(stub_of(module)) == signatures(generated.get()) != {}


@pytest.mark.parametrize("record", RESULTS)
def test_the_stub_has_the_keys_that_the_module_returns(record):
    fields = fields_of(record)
    assert set(fields) == set(RESULTS[record])
    for key, written in fields.items():
        if written in PLAIN:
            assert type(RESULTS[record][key]) is PLAIN[written], key
