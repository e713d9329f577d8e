"""Whether every entry of equivalents.toml still means just one fault of the code.

usage: entries_test.py BUILD_FOLDER [PIECE PIECES]
BUILD_FOLDER has been built: clang reads the headers that the build writes.
PIECE, from 0: one of PIECES parts of the files.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from command_line import LISTED, ROOT
from equivalents import Entry, faults_meant, read_entries
from project import Commands
from sites import CannotRead, arguments_for_clang, faults_of


def complaints_about(name: str, command: list[str], entries: list[Entry]) -> list[str]:
    try:
        found = faults_of(ROOT / name, arguments_for_clang(command))
    except CannotRead as e:
        return [f"{name}: {e}"]
    return faults_meant(entries, name, found)[1]


def main() -> int:
    piece, pieces = (int(text) for text in sys.argv[2:4]) if len(sys.argv) > 2 else (0, 1)
    entries = read_entries(LISTED, ROOT)
    commands = Commands(ROOT, Path(sys.argv[1]))
    names = sorted({entry.file for entry in entries})[piece::pieces]
    complaints = [c for name in names for c in complaints_about(name, commands.of(name), entries)]
    for complaint in complaints:
        print(complaint)
    counted = sum(1 for entry in entries if entry.file in names)
    print(f"{counted} entries for {len(names)} files: {len(complaints)} do not mean just one fault")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
