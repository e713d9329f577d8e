"""The compiled part, once the processor is known to do: all else of the package takes it from here."""

from pathlib import Path as _Path

from earshot import processor as _processor
from earshot.errors import BadInput

_processor.require(_Path(__file__).with_name("built_for.txt"))
try:
    from earshot._core import (
        SNR_ATTRIBUTES,
        TRANSMISSION_LOSS_ATTRIBUTES,
        BeliefState,
        Episodes,
        FrozenPolicy,
        Listening,
        Ocean,
        SoundStream,
        Tables,
        World,
        baselines,
        environment_crc32,
        evaluate,
        journal_fields,
        journal_records,
        listen_to_files,
        placed,
        radial,
        score,
        selections,
    )
except ModuleNotFoundError as missing:
    if missing.name != "earshot._core":
        raise
    raise ImportError(
        f"{_Path(__file__).parent} is the package's source, without its compiled part: pip install ./policy/python "
        "from the root of the repository"
    ) from None

__all__ = [
    "SNR_ATTRIBUTES",
    "TRANSMISSION_LOSS_ATTRIBUTES",
    "BadInput",
    "BeliefState",
    "Episodes",
    "FrozenPolicy",
    "Listening",
    "Ocean",
    "SoundStream",
    "Tables",
    "World",
    "baselines",
    "environment_crc32",
    "evaluate",
    "journal_fields",
    "journal_records",
    "listen_to_files",
    "placed",
    "radial",
    "score",
    "selections",
]
