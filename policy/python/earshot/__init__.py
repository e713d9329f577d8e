"""Earshot from Python: the search for an underwater source as a Gymnasium environment (`earshot.gym`).

Where lcm-gen has made types of Earshot's LCM messages, they are found here, too: `from earshot import nav_state_t`.
"""

from __future__ import annotations

import importlib as _importlib
import sys as _sys
import types as _types
from typing import Any as _Any

import earshot_name as _name

_OWN = {
    "BadInput": "earshot.errors",
    "BadType": "earshot.errors",
}
# Everything is imported when it is first used: who wants LCM types alone waits for nothing else.
__all__ = [
    "BadInput",
    "BadType",
]
__all__ += _name.type_names()


def __getattr__(name: str) -> _Any:
    if name in _OWN:
        value = getattr(_importlib.import_module(_OWN[name]), name)
    elif name.endswith("_t") and name in _name.type_names():
        value = getattr(_importlib.import_module(f"earshot.{name}"), name)
    else:
        raise AttributeError(f"module 'earshot' has no attribute {name!r}")
    globals()[name] = value
    return value


class _Package(_types.ModuleType):
    """Binds an LCM type where Python would bind the module that holds it: as lcm-gen's own package does."""

    def __setattr__(self, name: str, value: _Any) -> None:
        is_type = isinstance(value, _types.ModuleType) and name.endswith("_t")
        super().__setattr__(name, getattr(value, name) if is_type else value)


_sys.modules[__name__].__class__ = _Package
