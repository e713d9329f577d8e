"""What a reader has: a clone of the tree, here with the files as they are."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path


class Clone:
    """A clone in a folder, which becomes again what it was however commands leave it."""

    def __init__(self, tree: Path, files: list[str], folder: Path) -> None:
        """Of the files of a tree, named from its root."""
        self._tree, self._files, self._folder = tree, files, folder
        self._make()

    def clean(self) -> bool:
        """Takes out what commands left and puts back what they changed or removed.

        Returns whether that could be done; where not, the clone is made anew.
        """
        try:
            self._git("reset", "-q", "--hard", "as-it-is")
            self._git("clean", "-ffdxq")
        except subprocess.CalledProcessError:
            for entry in self._folder.iterdir():
                if entry.is_dir() and not entry.is_symlink():
                    shutil.rmtree(entry, ignore_errors=True)
                else:
                    entry.unlink()
            self._make()
            return False
        return True

    def _make(self) -> None:
        for name in self._files:
            (self._folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(self._tree / name, self._folder / name, follow_symlinks=False)
        self._git("init", "-q", "--template=")
        self._git("add", "--all", "--force")
        self._git("-c", "user.name=reader", "-c", "user.email=reader@localhost", "commit", "-qm", "as it is")
        self._git("tag", "as-it-is")

    def _git(self, *words: str) -> None:
        """Whatever the user's configuration says, and whatever repository the environment names."""
        environment = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
        environment |= {"GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1"}
        subprocess.run(["git", *words], cwd=self._folder, env=environment, check=True)
