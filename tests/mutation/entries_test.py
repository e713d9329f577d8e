"""Whether every entry of equivalents.toml still means just one fault of the code.

usage: entries_test.py BUILD_FOLDER   (one that has been built: clang reads the headers that the build writes)
"""

import os
import sys
from concurrent.futures import ProcessPoolExecutor
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
    return faults_meant(entries, name, (ROOT / name).read_text(), found)[1]


def main() -> int:
    entries = read_entries(LISTED, ROOT)
    commands = Commands(ROOT, Path(sys.argv[1]))
    with ProcessPoolExecutor(max_workers=os.cpu_count()) as pool:
        names = sorted({entry.file for entry in entries})
        looking = [pool.submit(complaints_about, name, commands.of(name), entries) for name in names]
        complaints = [complaint for future in looking for complaint in future.result()]
    for complaint in complaints:
        print(complaint)
    print(f"{len(entries)} entries for {len(names)} files: {len(complaints)} do not mean just one fault")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
