"""Where C++ can be mutated, and into what: read from its syntax, so comments and texts stay out."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

import tree_sitter
import tree_sitter_cpp
from tree_sitter import Node

PARSER = tree_sitter.Parser(tree_sitter.Language(tree_sitter_cpp.language()))

# Mutants of these would not compile, or change no behaviour.
LEFT_ALONE = {
    "comment",
    "template_argument_list",
    "template_parameter_list",
    "static_assert_declaration",
    "preproc_def",
    "preproc_function_def",
    "preproc_include",
    "preproc_call",
    "string_literal",
    "char_literal",
    "sizeof_expression",
    "bitfield_clause",
    "gnu_asm_expression",
    "attribute_specifier",
    "decltype",
    "operator_name",
}
# Node type: the field of it that is left alone.
FIELD_LEFT_ALONE = {
    "preproc_if": "condition",
    "preproc_elif": "condition",
    "case_statement": "value",
}
OTHER_OPERATORS = {
    "<": ("<=", ">="),
    "<=": ("<", ">"),
    ">": (">=", "<="),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "+": ("-",),
    "-": ("+",),
    "*": ("/",),
    "/": ("*",),
    "%": ("/",),
    "&": ("|",),
    "|": ("&",),
    "^": ("&",),
    "<<": (">>",),
    ">>": ("<<",),
    "+=": ("-=",),
    "-=": ("+=",),
    "*=": ("/=",),
    "/=": ("*=",),
    "|=": ("&=",),
    "&=": ("|=",),
    "<<=": (">>=",),
    ">>=": ("<<=",),
    "++": ("--",),
    "--": ("++",),
}
# Operators of which a mutant keeps one operand alone.
KEEPS_LEFT = {"+", "-", "&&", "||"}
KEEPS_RIGHT = {"&&", "||"}
# Functions that bound their first argument.
BOUNDING = {
    "clipped",
    "clamp",
    "clamped",
    "within",
    "atMost",
    "smaller",
    "fminf",
    "fmaxf",
    "fmin",
    "fmax",
}
CONDITIONED = {
    "if_statement",
    "while_statement",
    "do_statement",
    "for_statement",
    "conditional_expression",
}
NEGATED = {
    "call_expression",
    "identifier",
    "field_expression",
    "subscript_expression",
    "qualified_identifier",
}
SIDE = re.compile(rb"left|right|Left|Right")
OTHER_SIDE = {b"left": b"right", b"right": b"left", b"Left": b"Right", b"Right": b"Left"}
WHOLE = re.compile(r"(0x[0-9a-fA-F]+|\d+)([uUlL]*)")
DECIMAL = re.compile(r"((?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)([fF]?)")


@dataclass(frozen=True)
class Site:
    """One mutant of a text: `edit` replaces bytes of the expression or statement around them."""

    start: int
    end: int
    line: int
    last_line: int
    is_statement: bool
    is_condition: bool
    is_constant: bool  # known to the compiler alone, so that no switch can choose it at run time
    is_kept: bool  # of a function's static variable, which is worked out once for all tests
    edit: tuple[int, int, bytes]


@dataclass(frozen=True)
class Constexpr:
    """The word constexpr of a declaration, and what may stand there while a switch is in it."""

    start: int
    end: int
    declaration: tuple[int, int]
    instead: bytes


def read(text: bytes) -> tuple[list[Site], list[Constexpr]]:
    """All mutants of a C++ text, in its order, and its words constexpr."""
    root = PARSER.parse(text).root_node
    sites, words = [], []
    for node, is_constant in walk(root, False):
        sites += [site(node, is_constant, *each) for each in mutants_of(node)]
        if node.type == "type_qualifier" and node.text == b"constexpr":
            words.append(constexpr(node))
    return sorted(set(sites), key=lambda each: (each.start, -each.end, each.edit)), words


def walk(node: Node, is_constant: bool) -> Iterator[tuple[Node, bool]]:
    """The nodes in which mutants are looked for, and whether they are constants of an enum."""
    yield node, is_constant
    spared = FIELD_LEFT_ALONE.get(node.type)
    for index, child in enumerate(node.children):
        field = node.field_name_for_child(index)
        if child.type in LEFT_ALONE or (spared and field == spared):
            continue
        if node.type == "array_declarator" and field == "size":
            continue
        if is_row_of_words(node):
            continue
        yield from walk(child, is_constant or node.type == "enumerator")


def is_row_of_words(node: Node) -> bool:
    """Whether numbers are in a row with words: data, which a test could only repeat."""
    return node.type == "initializer_list" and any(
        child.type in ("string_literal", "concatenated_string") for child in node.named_children
    )


def site(node: Node, is_constant: bool, anchor: Node, edit: tuple, is_condition=False) -> Site:
    """A mutant as bytes and lines; `anchor` is what it is an alternative to."""
    statement = anchor.type.endswith("_statement")
    first, last = anchor.start_point[0] + 1, anchor.end_point[0] + 1
    line = 1 + node.start_point[0]
    return Site(
        anchor.start_byte, anchor.end_byte, line if first <= line <= last else first, last,
        statement, is_condition, is_constant, is_kept(node), edit,
    )  # fmt: skip


def is_kept(node: Node) -> bool:
    """Whether a node is in the initial value of a static variable of a function."""
    while node.parent is not None and node.type != "declaration":
        node = node.parent
    words = [child.text for child in node.children if child.type == "storage_class_specifier"]
    inside = node.parent is not None and node.parent.type == "compound_statement"
    return node.type == "declaration" and b"static" in words and inside


def mutants_of(node: Node) -> Iterator[tuple]:
    """Anchor, edit and whether it is a condition, for each mutant of one node."""
    kind = node.type
    if kind in ("binary_expression", "assignment_expression", "update_expression"):
        yield from of_operator(node)
    elif kind == "unary_expression" and node.child_by_field_name("operator").text in (b"-", b"!"):
        sign = node.child_by_field_name("operator")
        yield node, (sign.start_byte, sign.end_byte, b"")
    elif kind == "number_literal":
        yield from ((node, (node.start_byte, node.end_byte, new)) for new in of_number(node.text))
    elif kind in ("true", "false"):
        yield node, (node.start_byte, node.end_byte, b"false" if kind == "true" else b"true")
    elif kind in ("identifier", "field_identifier") and SIDE.search(node.text):
        yield from of_side(node)
    elif kind == "call_expression":
        yield from of_call(node)
    elif kind in CONDITIONED:
        yield from of_condition(node)
    if removable(node):
        yield node, (node.start_byte, node.end_byte, b"")


def of_operator(node: Node) -> Iterator[tuple]:
    """Another operator, or one operand alone."""
    operator = node.child_by_field_name("operator")
    sign = operator.text.decode()
    for other in OTHER_OPERATORS.get(sign, ()):
        yield node, (operator.start_byte, operator.end_byte, other.encode())
    if node.type != "binary_expression":
        return
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    is_condition = sign in KEEPS_RIGHT
    if sign in KEEPS_LEFT:
        yield node, (left.end_byte, node.end_byte, b""), is_condition
    if sign in KEEPS_RIGHT:
        yield node, (node.start_byte, right.start_byte, b""), is_condition


def of_number(text: bytes) -> list[bytes]:
    """Whole numbers by one more and one less, others halved; 0 becomes 1."""
    written = text.decode()
    if match := WHOLE.fullmatch(written):
        number = int(match[1], 0)
        near = [number + 1, number - 1] if number else [1]
        return [f"{each}{match[2]}".encode() for each in near]
    if match := DECIMAL.fullmatch(written):
        number = float(match[1])
        return [f"{number / 2 if number else 1.0}{match[2]}".encode()]
    return []


def of_side(node: Node) -> Iterator[tuple]:
    """Left for right, where a value is used."""
    anchor = node
    while anchor.parent is not None and (
        (
            anchor.parent.type == "field_expression"
            and anchor == anchor.parent.child_by_field_name("field")
        )
        or (anchor.parent.type == "qualified_identifier")
        or (
            anchor.parent.type == "call_expression"
            and anchor == anchor.parent.child_by_field_name("function")
        )
    ):
        anchor = anchor.parent
    if not is_value(anchor):
        return
    name = SIDE.sub(lambda match: OTHER_SIDE[match[0]], node.text)
    yield anchor, (node.start_byte, node.end_byte, name)


def is_value(node: Node) -> bool:
    """Whether an expression is used, not declared."""
    parent = node.parent
    if parent.type in ("init_declarator", "assignment_expression"):
        return node == (parent.child_by_field_name("value") or parent.child_by_field_name("right"))
    return parent.type.endswith("_expression") or parent.type in (
        "argument_list", "initializer_list", "return_statement", "condition_clause",
    )  # fmt: skip


def of_call(node: Node) -> Iterator[tuple]:
    """What a function bounds, without its bound."""
    name = node.child_by_field_name("function").text.decode().rpartition("::")[2]
    if name not in BOUNDING:
        return
    arguments = node.child_by_field_name("arguments").named_children
    kept = arguments if name in ("smaller", "fminf", "fmaxf", "fmin", "fmax") else arguments[:1]
    for argument in kept:
        yield node, (node.start_byte, node.end_byte, argument.text)


def of_condition(node: Node) -> Iterator[tuple]:
    """A condition's contrary, where no operator inside is turned round anyway."""
    condition = node.child_by_field_name("condition")
    if condition is not None and condition.type in ("condition_clause", "parenthesized_expression"):
        condition = condition.child_by_field_name("value") or condition.named_children[0]
    if condition is not None and condition.type in NEGATED:
        text = b"!(" + condition.text + b")"
        yield condition, (condition.start_byte, condition.end_byte, text), True


def removable(node: Node) -> bool:
    """Whether a statement may be left out and the function still compiles and returns."""
    if node.type in ("break_statement", "continue_statement"):
        return True
    if node.type == "expression_statement":
        return len(node.named_children) > 0
    if node.type != "return_statement":
        return False
    parent = node.parent
    while parent.type == "compound_statement":
        parent = parent.parent
    return parent.type == "if_statement"


def constexpr(node: Node) -> Constexpr:
    """What `constexpr` may become, by the kind of its declaration."""
    declaration = node.parent
    words = [child.text for child in declaration.children]
    in_class = declaration.parent.type == "field_declaration_list"
    if declaration.type == "function_definition":
        instead = b"" if in_class or b"inline" in words else b"inline"
    else:
        instead = b"inline const" if in_class else b"const"
    span = (declaration.start_byte, declaration.end_byte)
    return Constexpr(node.start_byte, node.end_byte, span, instead)
