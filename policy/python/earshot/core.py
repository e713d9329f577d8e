"""The compiled part, once the processor is known to do: all else of the package takes it from here."""

from pathlib import Path as _Path

from earshot import processor as _processor
from earshot.errors import BadInput

_processor.require(_Path(__file__).with_name("built_for.txt"))
try:
    from earshot._core import (
        LEVEL_ATTRIBUTES,
        MOST_TOML_BYTES,
        BeliefState,
        Episodes,
        FrozenPolicy,
        Listening,
        Ocean,
        RadialCase,
        SoundRequest,
        SoundStream,
        Tables,
        World,
        baselines,
        environment_crc32,
        evaluate,
        fan,
        journal_fields,
        journal_records,
        listen_to_files,
        placed,
        printable,
        radial,
        read_library,
        score,
        selections,
        write_shade,
        write_tl_grid,
    )
except ModuleNotFoundError as _missing:
    if _missing.name != "earshot._core":
        raise
    raise ImportError(
        f"{_Path(__file__).parent} is the package's source, without its compiled part: pip install ./policy/python "
        "from the root of the repository"
    ) from None

__all__ = [
    "LEVEL_ATTRIBUTES",
    "MOST_TOML_BYTES",
    "BadInput",
    "BeliefState",
    "Episodes",
    "FrozenPolicy",
    "Listening",
    "Ocean",
    "RadialCase",
    "SoundRequest",
    "SoundStream",
    "Tables",
    "World",
    "baselines",
    "environment_crc32",
    "evaluate",
    "fan",
    "journal_fields",
    "journal_records",
    "listen_to_files",
    "placed",
    "printable",
    "radial",
    "read_library",
    "score",
    "selections",
    "write_shade",
    "write_tl_grid",
]
