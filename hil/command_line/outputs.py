"""Files of results: whole or as they were, and never in the place of something else."""

from __future__ import annotations

import hashlib
import json
import os
import socket
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

from bad_input import BadInput

_PAGE_BEGINS = b"<!DOCTYPE html>"


def is_page(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(len(_PAGE_BEGINS)) == _PAGE_BEGINS


def is_junit_report(path: Path) -> bool:
    try:
        return ET.parse(path).getroot().tag in ("testsuites", "testsuite")
    except ET.ParseError:
        return False


def is_results(path: Path) -> bool:
    try:
        content = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        return False
    return isinstance(content, dict) and list(content) == ["cases"]


def require_writable(path: Path, kind: str, is_of_kind: Callable[[Path], bool], to_be_made: Path) -> None:
    """Judges before the work what would be refused after it. Raises BadInput.

    @param kind        with its article
    @param to_be_made  a folder that need not be there yet, as those that hold it
    """
    try:
        if path.exists():
            if not path.is_file():
                raise BadInput(f"{path}: is no regular file")
            if path.stat().st_size > 0 and not is_of_kind(path):
                raise BadInput(f"{path}: is not {kind}, and is not replaced; name another file")
        folder = path.resolve().parent
        made = to_be_made.resolve()
        if not folder.exists() and folder in (made, *made.parents):
            return
        if not folder.is_dir():
            raise BadInput(f"{path}: there is no folder {folder}")
        if not os.access(folder, os.W_OK):
            raise BadInput(f"{path}: nothing can be made in {folder}")
    except OSError as e:
        raise BadInput(f"{path}: {e.strerror}") from e
    except RuntimeError as e:  # Python 3.11's of links that lead in a circle
        raise BadInput(f"{path}: {e}") from e


def make_folder(path: Path) -> None:
    """Raises BadInput."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as e:
        raise BadInput(f"{path}: cannot be made a folder: {e.strerror}") from e


def take_folder(path: Path) -> socket.socket:
    """Raises BadInput while another hil/run writes into it. Held as long as what is returned.

    The kernel's name for it (abstract, unix(7)) goes with this process and leaves no file, and it holds where the lock
    of earshot-bench does not: out of user-mode Linux.
    """
    lock = socket.socket(socket.AF_UNIX)
    try:
        lock.bind(b"\0earshot hil/run " + hashlib.sha256(os.fsencode(path.resolve())).hexdigest().encode())
    except OSError as e:
        lock.close()
        raise BadInput(f"{path}: another hil/run is writing into it") from e
    return lock


def write_whole(path: Path, content: bytes) -> None:
    """Written beside its place, then renamed. A symbolic link stays; what it points to is replaced. Raises OSError."""
    target = path.resolve()
    descriptor, partial = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(partial, 0o666 & ~umask)
        os.replace(partial, target)
    except BaseException:
        os.unlink(partial)
        raise
