"""A copy is as it was, whatever the commands of a README did in it and whatever the user's Git is told to do."""

import os
import socket
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))
from tree_copy import TreeCopy

FILES = {"README.md": "read\nme\n", "sim/fly": "fly", "kept.key": "ignored by name", ".gitignore": "/out/\n*.key\n"}


def git(folder: Path, *words: str) -> None:
    """As a command of a README has it."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    subprocess.run(["git", *words], cwd=folder, env=environment | {"GIT_CONFIG_GLOBAL": "/dev/null"}, check=True)


def files_in(folder: Path) -> dict[str, str]:
    return {
        str(file.relative_to(folder)): file.read_text() if file.is_file() else "no file"
        for file in folder.rglob("*")
        if not file.is_dir()
    }


class OfATree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.room = Path(folder.name)
        self.tree, self.folder, self.elsewhere = self.room / "tree", self.room / "copy", self.room / "elsewhere"
        for name, text in FILES.items():
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            (self.tree / name).write_text(text)
        (self.tree / "sim/fly").chmod(0o755)
        self.elsewhere.mkdir()

    def copied(self) -> TreeCopy:
        return TreeCopy(self.tree, sorted(FILES), self.folder, self.room / "repository")

    def test_becomes_what_it_was(self):
        copy = self.copied()
        self.assertEqual(files_in(self.folder), FILES)
        (self.folder / "README.md").write_text("changed")
        (self.folder / "sim/fly").unlink()
        (self.folder / "kept.key").unlink()
        for left in ("new", "out/journal", "a.key", "deep/er/file"):
            (self.folder / left).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / left).write_text("left")
        git(self.folder, "init", "-q", "inner")
        (self.folder / "inner/file").write_text("left")
        os.mkfifo(self.folder / "pipe")
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(str(self.folder / "socket"))
        (self.folder / "sim").chmod(0o555)
        copy.clean()
        self.assertEqual(files_in(self.folder), FILES)
        self.assertTrue(os.access(self.folder / "sim/fly", os.X_OK))
        self.assertTrue(self.folder.joinpath("sim").stat().st_mode & 0o200)
        self.assertEqual({entry.name for entry in self.folder.iterdir()}, {name.split("/")[0] for name in FILES})

    def test_touches_nothing_elsewhere_though_a_command_made_a_repository_that_works_there(self):
        copy = self.copied()
        (self.elsewhere / "mine").write_text("mine")
        (self.folder / "link").symlink_to(self.elsewhere)
        git(self.folder, "init", "-q")
        git(self.folder, "config", "core.worktree", str(self.elsewhere))
        copy.clean()
        self.assertEqual(files_in(self.elsewhere), {"mine": "mine"})
        self.assertEqual(files_in(self.folder), FILES)

    def test_says_so_where_the_folder_is_no_longer_its_own(self):
        copy = self.copied()
        (self.elsewhere / "mine").write_text("mine")
        self.folder.rename(self.room / "moved")
        self.folder.symlink_to(self.elsewhere)
        self.assertRaises(OSError, copy.clean)
        self.assertEqual(files_in(self.elsewhere), {"mine": "mine"})
        self.folder.unlink()
        self.assertRaises((OSError, subprocess.CalledProcessError), copy.clean)

    def test_leaves_the_repository_alone_that_the_environment_names(self):
        git(self.elsewhere, "init", "-q")
        before = sorted((self.elsewhere / ".git").rglob("*"))
        named = {"GIT_DIR": str(self.elsewhere / ".git"), "GIT_INDEX_FILE": str(self.elsewhere / "index")}
        with mock.patch.dict(os.environ, named):
            self.copied().clean()
        self.assertEqual(sorted((self.elsewhere / ".git").rglob("*")), before)
        self.assertFalse((self.elsewhere / "index").exists())
        self.assertEqual(files_in(self.folder), FILES)

    def test_takes_no_notice_of_the_users_configuration(self):
        configuration = self.elsewhere / "git"
        configuration.mkdir()
        (configuration / "ignore").write_text("*.md\n")
        (configuration / "attributes").write_text("* text eol=crlf\n")
        (configuration / "config").write_text(
            "[commit]\n gpgSign = true\n[gpg]\n program = false\n[core]\n autocrlf = true\n"
        )
        with mock.patch.dict(os.environ, {"HOME": str(self.elsewhere), "XDG_CONFIG_HOME": str(self.elsewhere)}):
            copy = self.copied()
            (self.folder / "README.md").unlink()
            copy.clean()
        self.assertEqual((self.folder / "README.md").read_bytes(), b"read\nme\n")
        self.assertEqual(files_in(self.folder), FILES)


if __name__ == "__main__":
    unittest.main()
