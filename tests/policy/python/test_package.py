"""The package as it is installed: whose the name `earshot` is, what imports what, and what an error carries.

Run by ctest (run in this folder).
"""

import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import earshot
import earshot.gym
import earshot_gym
import earshot_gym._core
import earshot_gym.environment
import earshot_gym.vector
import earshot_gym.world
from earshot.gym.world import PAPER_ENVIRONMENT

ROOT = Path(__file__).resolve().parents[3]

# What who uses LCM types writes, and what who uses the package does, in one process.
BOTH = """
import earshot.setpoint_t
from earshot import nav_state_t
import earshot.gym, earshot_gym
sent = nav_state_t()
sent.depth_m = 12.5
assert nav_state_t.decode(sent.encode()).depth_m == 12.5
assert earshot.nav_state_t is nav_state_t and isinstance(earshot.setpoint_t, type)
assert earshot.gym.AcousticSearchEnv is earshot_gym.AcousticSearchEnv
assert issubclass(earshot.BadInput, ValueError)
"""


class Name(unittest.TestCase):
    """`lcm-gen -p` makes a package of the same name."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        definitions = map(str, (ROOT / "firmware/wire/lcm").glob("*.lcm"))
        command = ["lcm-gen", "-p", "--ppath", str(self.folder), *definitions]
        subprocess.run(command, check=True, capture_output=True)

    def run_python(self, program, **environment):
        done = subprocess.run(
            [sys.executable, "-c", program], cwd="/", env=environment, capture_output=True, text=True, check=False
        )
        self.assertEqual((done.stderr, done.returncode), ("", 0))
        return done.stdout

    def test_gives_both_where_the_types_stand_first_on_the_path(self):
        self.run_python(BOTH, PYTHONPATH=str(self.folder))

    def test_gives_both_where_the_types_stand_last_on_the_path(self):
        self.run_python(f"import sys; sys.path.append({str(self.folder)!r})" + BOTH)

    def test_gives_both_where_the_path_comes_after_the_package(self):
        self.run_python(f"import earshot.gym, sys; sys.path.insert(0, {str(self.folder)!r})" + BOTH)

    def test_gives_both_where_no_path_file_is_read(self):
        # As where the package was installed with pip install --target: the site's folders are on the path, by hand.
        site = str(Path(earshot.__file__).parents[1])
        own_first = f"import sys; sys.path[:0] = [{site!r}, {str(self.folder)!r}]"
        done = subprocess.run(
            [sys.executable, "-S", "-c", own_first + BOTH], capture_output=True, text=True, check=False
        )
        self.assertEqual((done.stderr, done.returncode), ("", 0))

    def test_gives_the_types_to_who_imports_all(self):
        self.run_python("from earshot import *\nassert isinstance(health_t, type)", PYTHONPATH=str(self.folder))

    def test_costs_who_wants_types_neither_numpy_nor_what_is_compiled(self):
        loaded = self.run_python(
            "import sys; from earshot import nav_state_t; print({'numpy', 'earshot._core'} & {*sys.modules})",
            PYTHONPATH=str(self.folder),
        )
        self.assertEqual(loaded, "set()\n")

    def test_is_no_folder_that_lcm_gen_did_not_make(self):
        (self.folder / "earshot/__init__.py").write_text('"""Someone\'s own."""\n')
        self.run_python("import earshot; assert not hasattr(earshot, 'nav_state_t')", PYTHONPATH=str(self.folder))

    def test_says_what_is_not_there(self):
        with self.assertRaisesRegex(AttributeError, "earshot.*no attribute 'nosuch_t'"):
            _ = earshot.nosuch_t


class Names(unittest.TestCase):
    def test_of_before_are_the_same_objects(self):
        self.assertIs(earshot_gym.make_world, earshot.gym.make_world)
        self.assertIs(earshot_gym._core.Episodes, earshot._core.Episodes)
        self.assertIs(earshot_gym.environment.AcousticSearchEnv, earshot.gym.AcousticSearchEnv)
        self.assertIs(earshot_gym.vector.AcousticSearchVectorEnv, earshot.gym.AcousticSearchVectorEnv)

    def test_of_before_are_read_in_pickles(self):
        pickled = pickle.dumps(
            earshot.gym.AcousticSearchEnv(max_steps=7), protocol=2
        )  # which names classes by lines of text
        self.assertIn(b"earshot.gym.environment", pickled)
        old = pickled.replace(b"earshot.gym.", b"earshot_gym.").replace(b"earshot._core", b"earshot_gym._core")
        self.assertEqual(pickle.loads(old).world.max_steps, 7)


class Errors(unittest.TestCase):
    def test_carry_file_line_key_and_value(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "ocean.toml"
            text = PAPER_ENVIRONMENT.read_text()
            file.write_text(text.replace("frequency_hz = 20.0", "frequency_hz = -3.5"))
            line = text[: text.index("frequency_hz")].count("\n") + 1
            with self.assertRaises(earshot.BadInput) as caught:
                earshot.gym.make_world(environment=file)
        bad = caught.exception
        self.assertEqual((bad.file, bad.line, bad.key, bad.value), (str(file), line, "source.frequency_hz", "-3.5"))
        again = pickle.loads(pickle.dumps(bad))
        self.assertEqual((str(again), again.key, again.line), (str(bad), bad.key, bad.line))

    def test_about_a_whole_file_carry_it_and_no_key(self):
        for text, file, line in (
            ("/nowhere/ocean.toml: no such file", "/nowhere/ocean.toml", None),
            ("/a b/c.env: cannot be read: it is a folder", "/a b/c.env", None),
            ("x/o.toml:3: not TOML: a key twice", "x/o.toml", 3),
        ):
            bad = earshot.BadInput(text)
            self.assertEqual((bad.file, bad.line, bad.key, bad.value), (file, line, None, None))

    def test_take_no_argument_and_value_for_a_file(self):
        bad = earshot.BadInput(
            "bearing = 0: meets land 3 m from the source, nearer than 5 m: there is nothing to compute"
        )
        self.assertEqual((bad.file, bad.line, bad.key, bad.value), (None, None, "bearing", "0"))

    def test_carry_the_argument(self):
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.gym.make_world(directions=77)
        bad = caught.exception
        self.assertEqual((bad.file, bad.line, bad.key, bad.value), (None, None, "directions", "77"))


if __name__ == "__main__":
    unittest.main()
