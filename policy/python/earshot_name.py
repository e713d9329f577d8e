"""Whose the import name `earshot` is: this package's, and the LCM types of lcm-gen's package `earshot` are found in it.

`lcm-gen -p` makes a package `earshot` of the messages, too. Whichever stood first on the path would hide the other.
So, wherever the two stand, `import earshot` finds the package beside this file, and `earshot.NAME_t` the type in the
first folder on the path that lcm-gen made. A `.pth` file imports this one at the start of Python: it must be light.
"""

from __future__ import annotations

import os
import sys
from importlib.machinery import ModuleSpec, PathFinder

__all__ = ["type_folders", "type_names"]

_HERE = os.path.dirname(os.path.abspath(__file__))
_MADE_BY_LCM_GEN = '"""LCM package __init__.py file'


def _is_made_by_lcm_gen(folder: str) -> bool:
    try:
        with open(os.path.join(folder, "__init__.py"), encoding="utf-8", errors="replace") as file:
            return file.readline().startswith(_MADE_BY_LCM_GEN)
    except OSError:
        return False


def type_folders() -> list[str]:
    """Folders of lcm-gen's package `earshot` that are on the path now, the first one first."""
    folders = (os.path.join(entry or os.getcwd(), "earshot") for entry in sys.path)
    return [folder for folder in folders if _is_made_by_lcm_gen(folder)]


def type_names() -> list[str]:
    """Names of the LCM types in them, "nav_state_t" and others."""
    return sorted({file[:-3] for folder in type_folders() for file in os.listdir(folder) if file.endswith("_t.py")})


class _EarshotFinder:
    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if name == "earshot":
            return PathFinder.find_spec(name, [_HERE])
        if name.startswith("earshot.") and name.endswith("_t"):
            return PathFinder.find_spec(name, type_folders())
        return None


sys.meta_path.insert(0, _EarshotFinder)
