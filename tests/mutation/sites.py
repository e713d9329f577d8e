"""Where in a C++ file a small fault can be planted, and which: read from clang's syntax tree."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from clang.cindex import Cursor, CursorKind, Index, TranslationUnit, TypeKind


@dataclass(frozen=True)
class Fault:
    """One change of a file: what stands from byte `start` to `end` becomes `text`."""

    start: int
    end: int
    text: str
    kind: str
    function: str  # whose body it stands in, by its qualified name; outside of functions the variable or member
    line: int
    change: str  # as a person reads it
    switchable: bool = True  # false where only the compiler looks: constants, sizes
    site: str | None = None  # "2 of 5" where a function has several switchable ones of a kind, in the order of its text


class CannotRead(Exception):
    """The compiler's complaint about a file."""


CHECKS = ("never true", "always true")  # kinds of faults of an if's condition
_ARITHMETIC = {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"], "<<": [">>"], ">>": ["<<"]}
_BITS = {"&": ["|"], "|": ["&"], "^": ["&"]}
_ASSIGNMENT = {"+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="], "|=": ["&="], "&=": ["|="], "^=": ["|="]}
_COMPARISON = {"<": [">="], "<=": [">"], ">": ["<="], ">=": ["<"], "==": ["!="], "!=": ["=="]}
_BOUNDARY = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
_LOGIC = {"&&": ["||"], "||": ["&&"]}
_UNITS = {60.0, 3600.0, 86400.0, 1000.0, 1e-3, 1e6, 1e-6, 1e9, 1e-9, 180.0, 1852.0}  # what a conversion multiplies with
_SYMMETRIC = {
    "min": 2,
    "max": 2,
    "clamp": 2,
    "lesser": 2,
    "greater": 2,
}  # so many of the first arguments may change places
_FUNCTIONS = {
    CursorKind.FUNCTION_DECL,
    CursorKind.CXX_METHOD,
    CursorKind.CONSTRUCTOR,
    CursorKind.DESTRUCTOR,
    CursorKind.CONVERSION_FUNCTION,
    CursorKind.FUNCTION_TEMPLATE,
}
_CASTS = {
    CursorKind.CXX_STATIC_CAST_EXPR,
    CursorKind.CXX_REINTERPRET_CAST_EXPR,
    CursorKind.CXX_CONST_CAST_EXPR,
    CursorKind.CXX_DYNAMIC_CAST_EXPR,
    CursorKind.CXX_FUNCTIONAL_CAST_EXPR,
    CursorKind.CSTYLE_CAST_EXPR,
}
_NEVER = {
    CursorKind.DECL_REF_EXPR,
    CursorKind.CXX_UNARY_EXPR,
    CursorKind.SIZE_OF_PACK_EXPR,
    CursorKind.TYPE_REF,
    CursorKind.TEMPLATE_REF,
    CursorKind.NAMESPACE_REF,
    CursorKind.TYPE_ALIAS_DECL,
    CursorKind.TYPEDEF_DECL,
    CursorKind.TEMPLATE_TYPE_PARAMETER,
    CursorKind.TEMPLATE_NON_TYPE_PARAMETER,
    CursorKind.USING_DECLARATION,
}


def arguments_for_clang(command: list[str]) -> list[str]:
    """Of a compiler's command what clang's parser needs: where includes are, definitions, the standard."""
    kept: list[str] = []
    words = iter(command[1:])
    for word in words:
        if word in ("-I", "-isystem", "-D", "-include"):
            kept += [word, next(words)]
        elif word.startswith(("-I", "-isystem", "-D", "-std=", "-m")):
            kept.append(word)
    return [*kept, "-x", "c++", "-w", "-Wno-error", "-fno-spell-checking"]


def qualified_name(cursor: Cursor) -> str:
    """Of a declaration, as C++ spells it; namespaces without a name are left out."""
    names: list[str] = []
    while cursor is not None and cursor.kind != CursorKind.TRANSLATION_UNIT:
        if cursor.spelling and not cursor.spelling.startswith("("):
            names.append(cursor.spelling)
        cursor = cursor.semantic_parent
    return "::".join(reversed(names))


def faults_of(file: Path, arguments: list[str]) -> list[Fault]:
    """Every fault that can be planted in `file`, in the order of its text."""
    unit = Index.create().parse(str(file), arguments, options=TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
    errors = [str(d) for d in unit.diagnostics if d.severity >= 3]
    if errors:
        raise CannotRead("\n".join(errors[:5]))
    reader = _Reader(file, unit)
    reader.declarations(unit.cursor)
    first: dict[tuple[int, int, str], Fault] = {}
    for fault in reader.faults:
        first.setdefault((fault.start, fault.end, fault.text), fault)
    return _with_sites(sorted(first.values(), key=lambda f: (f.start, -f.end, f.text)))


def _with_sites(faults: list[Fault]) -> list[Fault]:
    counts = Counter((f.function, f.kind) for f in faults if f.switchable)
    numbers: Counter[tuple[str, str]] = Counter()
    found: list[Fault] = []
    for fault in faults:
        alike = fault.function, fault.kind
        numbers[alike] += fault.switchable
        is_one_of_several = fault.switchable and counts[alike] > 1
        found.append(replace(fault, site=f"{numbers[alike]} of {counts[alike]}") if is_one_of_several else fault)
    return found


class _Reader:
    def __init__(self, file: Path, unit: TranslationUnit) -> None:
        self.name = str(file)
        self.bytes = file.read_bytes()
        self.faults: list[Fault] = []
        self.constant = False
        self.function_name = ""  # of what is being read
        self.named: set[int] = set()  # where constructors name what they initialise: no expression begins there
        self.macros = [
            (c.extent.start.offset, c.extent.end.offset)
            for c in unit.cursor.get_children()
            if c.kind == CursorKind.MACRO_INSTANTIATION
            and c.extent.start.file
            and c.extent.start.file.name == self.name
        ]

    def text(self, start: int, end: int) -> str:
        return self.bytes[start:end].decode()

    def of(self, cursor: Cursor) -> str:
        return self.text(cursor.extent.start.offset, cursor.extent.end.offset)

    def in_macro(self, start: int, end: int) -> bool:
        """Whether a piece of text begins or ends inside a macro's call."""
        return any(a <= start < b or a < end <= b for a, b in self.macros)

    def add(self, cursor: Cursor, text: str, kind: str, change: str = "") -> None:
        self.put(cursor.extent.start.offset, cursor.extent.end.offset, text, kind, change)

    def put(self, start: int, end: int, text: str, kind: str, change: str = "") -> None:
        if start > end or self.in_macro(start, end):
            return
        line = self.bytes.count(b"\n", 0, start) + 1
        told = change or f"{_short(self.text(start, end))} -> {_short(text)}"
        self.faults.append(Fault(start, end, text, kind, self.function_name, line, told, not self.constant))

    def declarations(self, cursor: Cursor) -> None:
        for child in cursor.get_children():
            place = child.extent.start.file
            if place is not None and place.name == self.name:
                self.visit(child)

    def visit_all(self, children: list[Cursor]) -> None:
        for child in children:
            self.visit(child)

    def visit_constant(self, children: list[Cursor]) -> None:
        before, self.constant = self.constant, True
        self.visit_all(children)
        self.constant = before

    def visit(self, cursor: Cursor) -> None:
        try:
            kind = cursor.kind
        except ValueError:  # newer than these bindings: concepts
            return
        children = list(cursor.get_children())
        if kind in _NEVER:
            return
        if kind in _FUNCTIONS:
            return self.function(cursor, children)
        is_template_variable = kind == CursorKind.UNEXPOSED_DECL and bool(cursor.spelling)
        if is_template_variable or kind in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL, CursorKind.PARM_DECL):
            return self.variable(cursor, children)
        if kind in (CursorKind.STATIC_ASSERT, CursorKind.ENUM_CONSTANT_DECL):
            return self.visit_constant(children)
        if kind == CursorKind.CASE_STMT:
            self.visit_constant(children[:1])
            return self.statements(children[1:])
        if kind == CursorKind.LAMBDA_EXPR:
            return self.visit_all([c for c in children if c.kind == CursorKind.COMPOUND_STMT])
        if kind in _CASTS:
            return self.visit_all(children[-1:])
        if kind == CursorKind.MEMBER_REF_EXPR:
            return self.visit_all([c for c in children if c.extent.end.offset <= cursor.location.offset])
        self.statement_or_expression(cursor, children)

    def statement_or_expression(self, cursor: Cursor, children: list[Cursor]) -> None:
        kind = cursor.kind
        if kind == CursorKind.CALL_EXPR:
            return self.call(cursor, children)
        if kind in (CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR) and len(children) == 2:
            self.binary(cursor, children[0], children[1])
        elif kind == CursorKind.UNARY_OPERATOR and children:
            self.unary(cursor, children[0])
        elif kind in (CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL, CursorKind.CXX_BOOL_LITERAL_EXPR):
            self.literal(cursor)
        elif kind == CursorKind.CONDITIONAL_OPERATOR:
            self.add(children[0], f"!({self.of(children[0])})", "comparison")
        elif kind == CursorKind.IF_STMT:
            return self.check(cursor, children)
        elif kind in (CursorKind.WHILE_STMT, CursorKind.FOR_STMT, CursorKind.CXX_FOR_RANGE_STMT):
            self.visit_all(children[:-1])
            return self.statements(children[-1:])
        elif kind in (CursorKind.COMPOUND_STMT, CursorKind.DEFAULT_STMT):
            return self.statements(children)
        elif self.of(cursor).startswith("__builtin_shufflevector("):  # its indices are for the compiler
            return self.visit_constant(children)
        self.visit_all(children)

    def function(self, cursor: Cursor, children: list[Cursor]) -> None:
        at = cursor.location.offset
        if re.search(r"=\s*(default|delete)\s*$", self.of(cursor)):
            return
        before = self.constant, self.function_name
        self.constant = self.constant or "consteval" in self.text(cursor.extent.start.offset, at)
        self.function_name = qualified_name(cursor)
        self.function_body(cursor, [c for c in children if c.extent.start.offset > at])
        self.constant, self.function_name = before

    def function_body(self, cursor: Cursor, children: list[Cursor]) -> None:
        names = [c for c in children if c.kind in (CursorKind.MEMBER_REF, CursorKind.TYPE_REF)]
        self.named |= {c.extent.start.offset for c in names}
        self.visit_all(children)
        body = next((c for c in children if c.kind == CursorKind.COMPOUND_STMT), None)
        is_plain = cursor.kind not in (CursorKind.CONSTRUCTOR, CursorKind.DESTRUCTOR)
        if body is None or not is_plain or not list(body.get_children()):
            return
        inside = body.extent.start.offset + 1
        if self.text(inside - 1, inside) != "{":  # clang gives a function that is defaulted a body of its own
            return
        is_void = cursor.result_type.get_canonical().kind == TypeKind.VOID
        returned = "return;" if is_void else "return {};"
        self.put(inside, inside, returned, "early return", f"{cursor.spelling} begins with {returned}")

    def variable(self, cursor: Cursor, children: list[Cursor]) -> None:
        at = cursor.location.offset
        is_constant = "constexpr" in self.text(cursor.extent.start.offset, at)
        before = self.function_name
        self.function_name = before or qualified_name(cursor)
        for child in children:
            start = child.extent.start.offset
            between = self.text(at, start) if start > at else ""
            is_size = between.rstrip().endswith("[") or (cursor.kind == CursorKind.FIELD_DECL and cursor.is_bitfield())
            if start > at:
                (self.visit_constant if is_constant or is_size else self.visit_all)([child])
        self.function_name = before

    def statements(self, children: list[Cursor]) -> None:
        """What stands as a statement: each may be left out."""
        for child in children:
            has_effect = child.kind in (CursorKind.CALL_EXPR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR)
            is_step = child.kind == CursorKind.UNARY_OPERATOR and re.search(r"\+\+|--", self.of(child))
            is_assignment = child.kind == CursorKind.BINARY_OPERATOR and self.operator_of(child) == "="
            if has_effect or is_step or is_assignment:
                self.add(child, "", "dropped statement", f"{_short(self.of(child))} left out")
            self.visit(child)

    def check(self, cursor: Cursor, children: list[Cursor]) -> None:
        """if (condition) statement [else statement]"""
        head = self.text(cursor.extent.start.offset, children[0].extent.start.offset)
        if "constexpr" in head or "consteval" in head:
            self.visit_constant(children[:1])
            return self.statements(children[1:])
        condition = next((c for c in children if c.kind.is_expression()), None)
        if condition is not None and children[0].kind != CursorKind.VAR_DECL:
            told = _short(self.of(condition))
            never, always = CHECKS
            self.add(condition, "false", never, f"if ({told}) never")
            self.add(condition, "true", always, f"if ({told}) always")
            self.visit(condition)
            children = [c for c in children if c != condition]
        self.statements(children)

    def operator_of(self, cursor: Cursor) -> str:
        children = list(cursor.get_children())
        between = self.text(children[0].extent.end.offset, children[1].extent.start.offset)
        return re.sub(r"//[^\n]*|/\*.*?\*/", "", between, flags=re.DOTALL).strip() if len(children) == 2 else ""

    def binary(self, cursor: Cursor, left: Cursor, right: Cursor) -> None:
        between = self.text(left.extent.end.offset, right.extent.start.offset)
        operator = re.sub(r"//[^\n]*|/\*.*?\*/", "", between, flags=re.DOTALL).strip()
        for kind, table in {
            "sign": {k: v for k, v in _ARITHMETIC.items() if k in "+-"},
            "arithmetic": {k: v for k, v in _ARITHMETIC.items() if k not in "+-"},
            "bits": _BITS,
            "assignment": _ASSIGNMENT,
            "comparison": _COMPARISON,
            "boundary": {k: [v] for k, v in _BOUNDARY.items()},
            "logic": _LOGIC,
        }.items():
            for other in table.get(operator, []):
                told = f"{_short(self.of(left))} {operator} {_short(self.of(right))}: {operator} -> {other}"
                self.add(cursor, f"({self.of(left)}) {other} ({self.of(right)})", kind, told)

    def unary(self, cursor: Cursor, operand: Cursor) -> None:
        whole, inner = self.of(cursor), self.of(operand)
        sign = whole.removesuffix(inner).strip() if whole.endswith(inner) else whole.removeprefix(inner).strip()
        is_before = whole.endswith(inner)
        if sign in ("-", "!") and is_before:
            told = (
                f"{_short(whole)} -> {_short(inner)}"  # cast: a chain of conditions would make an optional of its bool
            )
            if sign == "-":
                self.add(cursor, f"({inner})", "sign", told)
            else:
                self.add(cursor, f"static_cast<bool>({inner})", "logic", told)
        elif sign in ("++", "--"):
            other = "--" if sign == "++" else "++"
            self.add(cursor, f"{other}{inner}" if is_before else f"{inner}{other}", "sign")

    def literal(self, cursor: Cursor) -> None:
        written = self.of(cursor)
        if written in ("true", "false"):
            return self.add(cursor, "false" if written == "true" else "true", "constant")
        if cursor.kind == CursorKind.INTEGER_LITERAL:
            if re.match(r"0[xXbB]|[0-9]", written):
                self.add(cursor, f"{written} + 1", "off by one" if not written.startswith("0x") else "constant")
            return None
        value = re.fullmatch(r"([0-9.]+(?:[eE][-+]?\d+)?)([fFlL]?)|(0[xX].*)", written.replace("'", ""))
        if value is None:
            return None
        number = float(value.group(1)) if value.group(1) else float.fromhex(written.rstrip("fFlL"))
        if number in _UNITS:
            return self.add(cursor, f"1.0{value.group(2) or ''}", "units")
        if number == 0.0:
            return self.add(cursor, f"1.0{value.group(2) or ''}", "constant")
        return self.add(cursor, f"{written} * 1.01{value.group(2) or ''}", "constant")

    def call(self, cursor: Cursor, children: list[Cursor]) -> None:
        name = cursor.spelling
        if name.startswith("operator") and len(children) == 3 and not name[8:].strip(" ").isalnum():
            left, called, right = sorted(children, key=lambda c: c.extent.start.offset)
            if self.text(called.extent.start.offset, called.extent.end.offset) == name[8:]:
                self.binary(cursor, left, right)
                return self.visit_all([left, right])
        given = [a for a in cursor.get_arguments() if a is not None and a.extent.end.offset > a.extent.start.offset]
        is_initialiser = cursor.extent.start.offset in self.named
        for one, other in _neighbours([] if is_initialiser else given[max(0, _SYMMETRIC.get(name, 0) - 1) :]):
            if self.of(one) != self.of(other) and _same_type(one, other):
                self.swap(cursor, one, other)
        first = children[:1] if children and children[0].kind == CursorKind.MEMBER_REF_EXPR else []
        if not given and len(children) == 1:
            first = children
        return self.visit_all([*first, *(a for a in given if a not in first)])

    def swap(self, cursor: Cursor, one: Cursor, other: Cursor) -> None:
        a, b = one.extent, other.extent
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        if not start <= a.start.offset < a.end.offset <= b.start.offset < b.end.offset <= end:
            return
        text = (
            self.text(start, a.start.offset)
            + self.of(other)
            + self.text(a.end.offset, b.start.offset)
            + self.of(one)
            + self.text(b.end.offset, end)
        )
        self.add(
            cursor, text, "swapped arguments", f"{_short(self.of(cursor))}: {_short(self.of(one))} <-> {self.of(other)}"
        )


def _neighbours(cursors: list[Cursor]) -> Iterator[tuple[Cursor, Cursor]]:
    return zip(cursors, cursors[1:], strict=False)


def _same_type(one: Cursor, other: Cursor) -> bool:
    def name(cursor: Cursor) -> str:
        return cursor.type.get_canonical().spelling.replace("const ", "").rstrip("& ")

    return name(one) == name(other)


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 60 else line[:57] + "..."
