"""A clone is as it was, whatever the commands of a README did in it and whatever the user's Git is told to do."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))
from clone import Clone

FILES = {"README.md": "read me", "sim/fly": "fly", "kept.key": "a name that .gitignore has", ".gitignore": "/out/\n*.key\n"}


def files_in(folder: Path) -> dict[str, str]:
    return {
        str(file.relative_to(folder)): file.read_text()
        for file in folder.rglob("*")
        if file.is_file() and ".git" not in file.relative_to(folder).parts
    }


class OfATree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        tree, self.folder = Path(folder.name) / "tree", Path(folder.name) / "clone"
        for name, text in FILES.items():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            (tree / name).write_text(text)
        (tree / "sim/fly").chmod(0o755)
        self.make = lambda: Clone(tree, sorted(FILES), self.folder)
        self.elsewhere = Path(folder.name) / "elsewhere"

    def test_becomes_what_it_was(self):
        clone = self.make()
        self.assertEqual(files_in(self.folder), FILES)
        (self.folder / "README.md").write_text("changed")
        (self.folder / "sim/fly").unlink()
        (self.folder / "kept.key").unlink()
        for left in ("new", "out/journal", "a.key", "deep/er/file"):
            (self.folder / left).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / left).write_text("left")
        subprocess.run(["git", "init", "-q", "inner"], cwd=self.folder, check=True)
        (self.folder / "inner/file").write_text("left")
        self.assertTrue(clone.clean())
        self.assertEqual(files_in(self.folder), FILES)
        self.assertTrue(os.access(self.folder / "sim/fly", os.X_OK))
        self.assertFalse((self.folder / "out").exists() or (self.folder / "inner").exists())

    def test_becomes_what_it_was_where_a_command_committed(self):
        clone = self.make()
        (self.folder / "new").write_text("left")
        for words in (["add", "-A"], ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "new"]):
            subprocess.run(["git", *words], cwd=self.folder, check=True)
        self.assertTrue(clone.clean())
        self.assertEqual(files_in(self.folder), FILES)

    def test_is_made_anew_where_its_repository_is_gone_and_says_so(self):
        clone = self.make()
        (self.folder / ".git/HEAD").unlink()
        (self.folder / "new").write_text("left")
        self.assertFalse(clone.clean())
        self.assertEqual(files_in(self.folder), FILES)
        self.assertTrue(clone.clean())

    def test_leaves_the_repository_alone_that_the_environment_names(self):
        self.elsewhere.mkdir()
        subprocess.run(["git", "init", "-q"], cwd=self.elsewhere, check=True)
        before = sorted((self.elsewhere / ".git").rglob("*"))
        named = {"GIT_DIR": str(self.elsewhere / ".git"), "GIT_INDEX_FILE": str(self.elsewhere / "index")}
        with mock.patch.dict(os.environ, named):
            self.assertTrue(self.make().clean())
        self.assertEqual(sorted((self.elsewhere / ".git").rglob("*")), before)
        self.assertFalse((self.elsewhere / "index").exists())
        self.assertEqual(files_in(self.folder), FILES)

    def test_takes_no_notice_of_the_users_configuration(self):
        self.elsewhere.mkdir()
        (self.elsewhere / "ignored").write_text("*.md\n")
        configuration = self.elsewhere / ".gitconfig"
        configuration.write_text(
            f"[commit]\n gpgSign = true\n[tag]\n gpgSign = true\n[gpg]\n program = false\n[core]\n excludesFile = {self.elsewhere}/ignored\n"
        )
        with mock.patch.dict(os.environ, {"HOME": str(self.elsewhere)}):
            self.assertTrue(self.make().clean())
        self.assertEqual(files_in(self.folder), FILES)


if __name__ == "__main__":
    unittest.main()
