"""A copy of the tree in which commands run, and which becomes again what it was."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path


class TreeCopy:
    """Git knows what it was, from a repository that stands elsewhere: no command finds or moves it."""

    def __init__(self, tree: Path, files: list[str], folder: Path, repository: Path) -> None:
        """Of the files of a tree, named from its root. A clone's repository is its .git; it is never cleaned."""
        self.folder, self._repository = folder, repository
        folder.mkdir(parents=True, exist_ok=True)
        for name in files:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(tree / name, folder / name, follow_symlinks=False)
        self._git("init", "--quiet", "--template=")
        self._git("add", "--all", "--force")
        self._git("-c", "user.name=reader", "-c", "user.email=reader@localhost", "commit", "--quiet", "-m", "as it is")

    def clean(self) -> None:
        """Takes out what commands left and puts back what they changed or removed.

        Raises OSError or subprocess.CalledProcessError where that cannot be done.
        """
        if self.folder.is_symlink():
            raise OSError(f"{self.folder}: has become a symbolic link")
        subprocess.run(["chmod", "--recursive", "--silent", "u+rwX", str(self.folder)], check=True)
        # Neither does Git look at: pipes and sockets, and a repository of the folder's own.
        subprocess.run(["find", str(self.folder), "(", "-type", "p", "-o", "-type", "s", ")", "-delete"], check=True)
        own = self.folder / ".git"
        if own.is_dir() and not own.is_symlink():
            shutil.rmtree(own)
        else:
            own.unlink(missing_ok=True)
        self._git("reset", "--quiet", "--hard")
        self._git("clean", "--quiet", "-ffdx")

    def _git(self, *words: str) -> None:
        """Whatever the user's configuration says, and whatever repository the environment names."""
        environment = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
        environment |= {"GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1", "GIT_ATTR_NOSYSTEM": "1"}
        where = [f"--git-dir={self._repository}", f"--work-tree={self.folder}", "-c", "core.attributesFile=/dev/null"]
        where += ["-c", "core.excludesFile=/dev/null"]
        subprocess.run(["git", *where, *words], cwd=self.folder, env=environment, check=True)
