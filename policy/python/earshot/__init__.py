"""Earshot from Python: sound fields, calls in recordings, journals of flights, and the search for an underwater source.

>>> import earshot
>>> env = earshot.Environment(sound_speed=earshot.Munk(), bathymetry=3000.0, sediment=earshot.Layer(1505.0))
>>> sound = earshot.field(env, frequency=20.0, source_depth=30.0)
>>> sound.transmission_loss.sel(depth=300.0).plot()

Where lcm-gen has made types of Earshot's LCM messages, they are found here, too: `from earshot import nav_state_t`.
"""

import importlib as _importlib
import sys as _sys
import types as _types
from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import Any as _Any

import earshot_name as _name

if _TYPE_CHECKING:
    from earshot import annotations as annotations
    from earshot.beliefs import Belief as Belief
    from earshot.errors import BadInput as BadInput
    from earshot.errors import BadType as BadType
    from earshot.evaluations import EvaluationWarning as EvaluationWarning
    from earshot.evaluations import baselines as baselines
    from earshot.evaluations import evaluate as evaluate
    from earshot.fans import fan as fan
    from earshot.fans import horizontal_map as horizontal_map
    from earshot.fields import FieldWarning as FieldWarning
    from earshot.fields import field as field
    from earshot.flights import Flight as Flight
    from earshot.flights import FlightLost as FlightLost
    from earshot.flights import fly as fly
    from earshot.heard import Completed as Completed
    from earshot.heard import Heard as Heard
    from earshot.heard import RecordingWarning as RecordingWarning
    from earshot.journals import JournalWarning as JournalWarning
    from earshot.journals import read_journal as read_journal
    from earshot.libraries import library as library
    from earshot.listening import Listener as Listener
    from earshot.listening import listen as listen
    from earshot.model_files import write_shd as write_shd
    from earshot.model_files import write_tl_grid as write_tl_grid
    from earshot.ocean_parts import Layer as Layer
    from earshot.ocean_parts import Munk as Munk
    from earshot.ocean_parts import SeaWater as SeaWater
    from earshot.ocean_tables import Tables as Tables
    from earshot.ocean_tables import tables as tables
    from earshot.oceans import Environment as Environment

_OWN = {
    "BadInput": "earshot.errors",
    "BadType": "earshot.errors",
    "Belief": "earshot.beliefs",
    "Completed": "earshot.heard",
    "Environment": "earshot.oceans",
    "EvaluationWarning": "earshot.evaluations",
    "FieldWarning": "earshot.fields",
    "Flight": "earshot.flights",
    "FlightLost": "earshot.flights",
    "Heard": "earshot.heard",
    "Layer": "earshot.ocean_parts",
    "Listener": "earshot.listening",
    "Munk": "earshot.ocean_parts",
    "SeaWater": "earshot.ocean_parts",
    "JournalWarning": "earshot.journals",
    "RecordingWarning": "earshot.heard",
    "Tables": "earshot.ocean_tables",
    "baselines": "earshot.evaluations",
    "evaluate": "earshot.evaluations",
    "fan": "earshot.fans",
    "field": "earshot.fields",
    "fly": "earshot.flights",
    "horizontal_map": "earshot.fans",
    "library": "earshot.libraries",
    "listen": "earshot.listening",
    "read_journal": "earshot.journals",
    "tables": "earshot.ocean_tables",
    "write_shd": "earshot.model_files",
    "write_tl_grid": "earshot.model_files",
}
# Everything is imported when it is first used: who wants LCM types alone waits for nothing else.
__all__ = ["annotations", *_OWN, *_name.type_names()]  # noqa: PLE0604  (texts, all of them)


def __getattr__(name: str) -> _Any:
    if name in _OWN:
        value = getattr(_importlib.import_module(_OWN[name]), name)
    elif name == "annotations":
        value = _importlib.import_module("earshot.annotations")
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
