"""Earshot from Python: sound fields (`earshot.field`), and the search for an underwater source (`earshot.gym`).

>>> import earshot
>>> env = earshot.Environment(sound_speed=earshot.Munk(), bathymetry=3000.0, sediment=earshot.Layer(1505.0))
>>> sound = earshot.field(env, frequency=20.0, source_depth=30.0)
>>> sound.transmission_loss.sel(depth=300.0).plot()

Where lcm-gen has made types of Earshot's LCM messages, they are found here, too: `from earshot import nav_state_t`.
"""

from __future__ import annotations

import importlib as _importlib
import sys as _sys
import types as _types
from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import Any as _Any

import earshot_name as _name

if _TYPE_CHECKING:
    from earshot.errors import BadInput as BadInput
    from earshot.errors import BadType as BadType
    from earshot.fields import field as field
    from earshot.journals import JournalWarning as JournalWarning
    from earshot.journals import read_journal as read_journal
    from earshot.ocean_parts import Layer as Layer
    from earshot.ocean_parts import Munk as Munk
    from earshot.ocean_parts import SeaWater as SeaWater
    from earshot.oceans import Environment as Environment

_OWN = {
    "BadInput": "earshot.errors",
    "BadType": "earshot.errors",
    "Environment": "earshot.oceans",
    "Layer": "earshot.ocean_parts",
    "Munk": "earshot.ocean_parts",
    "SeaWater": "earshot.ocean_parts",
    "JournalWarning": "earshot.journals",
    "field": "earshot.fields",
    "read_journal": "earshot.journals",
}
# Everything is imported when it is first used: who wants LCM types alone waits for nothing else.
__all__ = [*_OWN, *_name.type_names()]  # noqa: PLE0604  (texts, all of them)


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
