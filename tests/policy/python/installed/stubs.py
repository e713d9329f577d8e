"""The interface files of the package against what is there once it is installed.

Names and kinds by mypy's stubtest; it sees no arguments of what C++ gives, which are compared here.

usage: PYTHON tests/policy/python/installed/stubs.py SITE_PACKAGES
PYTHON: one with mypy; SITE_PACKAGES: where the package is
"""

import ast
import importlib.util
import re
import sys
import tempfile
import types
from pathlib import Path

from mypy import stubtest

ROOT = Path(__file__).resolve().parents[4]

# Types are checked elsewhere (toolchains/format).
_CONFIGURATION = f"""[mypy]
mypy_path = {ROOT / "policy/python"}
ignore_errors = True
ignore_missing_imports = True
no_site_packages = True
"""

# What stubtest takes for a difference, and is none: patterns of names.
_NONE = (
    r"earshot\.__all__",  # has the names of _OWN, which mypy does not compute
    r"earshot\.(_core|_search)\.[A-Z]\w+",  # their metaclass is pybind11's
    r"earshot\.(_core\.(Ocean|RadialCase)|_search\.Tables)\.__init__",  # nobody makes one but by its static methods
    r"earshot\.\w+\.pandas",  # imported for types alone
    r"earshot\.gym\.world\._solved",  # what lru_cache makes of it
)
_WITHOUT_SB3 = (r"earshot(_|\.)gym\.sb3",)


def arguments_stated(function):
    """Of a function in an interface file: its arguments, with * where only names do from there on."""
    known = function.args
    starred = ["*"] * bool(known.kwonlyargs)
    return [a.arg for a in known.posonlyargs + known.args] + starred + [a.arg for a in known.kwonlyargs]


def arguments_compiled(text):
    """Of what pybind11 says of a function: "name(first: type[a, b] = 1, *, second: type) -> type"."""
    inner = text[text.index("(") + 1 : text.rindex(") -> ")]
    while (shorter := re.sub(r"\[[^\[\]]*\]|\([^()]*\)", "", inner)) != inner:
        inner = shorter
    return [part.split(":")[0].split("=")[0].strip() for part in inner.split(",") if part.strip()]


def differing_arguments(core):
    """Functions whose arguments are others in the interface file than in the module."""
    wrong = []
    for file in ("_core.pyi", "_search.pyi"):
        tree = ast.parse((ROOT / "policy/python/earshot" / file).read_text())
        scopes = [(core, tree.body)]
        scopes += [(getattr(core, node.name), node.body) for node in tree.body if isinstance(node, ast.ClassDef)]
        for scope, body in scopes:
            for function in body:
                is_property = isinstance(function, ast.FunctionDef) and any(
                    isinstance(mark, ast.Name) and mark.id == "property" for mark in function.decorator_list
                )
                if not isinstance(function, ast.FunctionDef) or is_property:
                    continue
                if not hasattr(scope, function.name):
                    continue  # stubtest names it
                stated = arguments_stated(function)
                compiled = arguments_compiled(getattr(scope, function.name).__doc__)
                if stated[:1] == ["self"]:
                    compiled[:1] = ["self"]  # of a class: pybind11 may call it otherwise
                if stated != compiled:
                    wrong.append(f"{file}: {function.name}({', '.join(stated)}), compiled: ({', '.join(compiled)})")
    return wrong


def main(site_packages):
    sys.path.append(site_packages)  # behind mypy's own
    core = importlib.import_module("earshot._core")
    part = types.ModuleType("earshot._search")  # a part of the interface of _core, for a file is to be short
    part.__dict__.update({name: getattr(core, name) for name in ("Tables", "BeliefState", "baselines", "evaluate")})
    sys.modules[part.__name__] = part
    is_sb3_there = importlib.util.find_spec("stable_baselines3") is not None
    with tempfile.TemporaryDirectory() as folder:
        configuration, allowed = Path(folder) / "mypy.ini", Path(folder) / "allowed.txt"
        configuration.write_text(_CONFIGURATION)
        allowed.write_text("\n".join(_NONE + (() if is_sb3_there else _WITHOUT_SB3)))
        options = ["--mypy-config-file", str(configuration), "--allowlist", str(allowed), "--ignore-unused-allowlist"]
        sys.argv = ["stubtest", "earshot", "earshot_gym", "earshot_name", *options]
        differences = differing_arguments(core)
        print("\n".join(differences), end="\n" * bool(differences))
        return stubtest.main() or bool(differences)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
