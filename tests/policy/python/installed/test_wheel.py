"""The wheel of policy/python on a computer that has only Python.

What it is linked with, and what a process that flies a search has loaded.

usage: test_wheel.py WHEEL ENVIRONMENT
ENVIRONMENT: a virtual environment into which the wheel is installed, of which nothing else is known
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

WHEEL, ENVIRONMENT = Path(sys.argv[1]), Path(sys.argv[2])
ROOT = Path(__file__).resolve().parents[4]
HILLY = ROOT / "policy/worlds/oceans/hilly.toml"  # its field library is a NetCDF file

# Of the GNU C library; everything else must be in the wheel.
LIBC = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}

FLIGHT = """
import gymnasium, earshot_gym, re
env = gymnasium.make(earshot_gym.ID, state="belief", source="changing")
observation, _ = env.reset(seed=1)
for _ in range(100):
    observation, reward, terminated, truncated, info = env.step(2)
    if terminated or truncated:
        break
assert terminated or truncated
assert observation.shape == env.observation_space.shape
print(*sorted({line.split()[-1] for line in open("/proc/self/maps") if re.search(r"[.]so([.]|$)", line)}), sep="\\n")
"""


def needed(library: Path) -> set[str]:
    text = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r"\(NEEDED\).*\[(.+)\]", text))


class Wheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def python(self, program, **environment):
        """Runs it far from the tree, with an environment that names nothing of this computer."""
        return subprocess.run(
            [ENVIRONMENT / "bin/python", "-c", program],
            check=False,
            cwd=self.folder,
            env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8", **environment},
            capture_output=True,
            text=True,
        )

    def test_is_linked_with_nothing_but_the_c_library(self):
        with zipfile.ZipFile(WHEEL) as wheel:
            wheel.extractall(self.folder)
        libraries = {path.name: needed(path) for path in self.folder.rglob("*.so*")}
        self.assertTrue(libraries)
        for name, wants in libraries.items():
            with self.subTest(library=name):
                self.assertLessEqual(wants, LIBC)

    def test_flies_a_search_with_no_library_of_this_computer_but_those_of_python(self):
        flown = self.python(FLIGHT)
        self.assertEqual(flown.returncode, 0, flown.stderr)
        without = self.python(
            FLIGHT.replace("earshot_gym.ID", "'CartPole-v1'")
            .replace(', state="belief", source="changing"', "")
            .replace("env.step(2)", "env.step(0)")
            .replace("earshot_gym, ", "")
        )  # the same of Gymnasium alone
        self.assertEqual(without.returncode, 0, without.stderr)
        own = str(ENVIRONMENT.resolve())
        more = [path for path in set(flown.stdout.split()) - set(without.stdout.split()) if not path.startswith(own)]
        self.assertEqual(more, [])

    def test_reads_a_field_library_with_the_netcdf_of_the_computer(self):
        read = self.python(
            f"import earshot_gym; print(earshot_gym.make_world(environment={str(HILLY)!r}).observation_size)"
        )
        self.assertEqual((read.returncode, read.stdout), (0, "2\n"), read.stderr)

    def test_computes_a_field(self):
        computed = self.python(
            "import earshot as e; env = e.Environment(sound_speed=1500.0, bathymetry=100.0, sediment=e.Layer(1600.0))\n"
            "print(e.field(env, frequency=50.0, source_depth=30.0, max_range=500.0).transmission_loss.shape)"
        )
        self.assertEqual((computed.returncode, computed.stdout), (0, "(100, 100)\n"), computed.stderr)

    def test_computes_a_fan_and_the_case_of_another_model(self):
        computed = self.python(
            f"import earshot as e; env = e.Environment.from_ram({str(ROOT / 'sim/ocean/environments/slope.in')!r})\n"
            "e.write_tl_grid(e.field(env), 'tl.grid')\n"
            "print(e.fan(env, radials=3, receiver_depth=30.0, max_range=500.0).transmission_loss.shape)"
        )
        self.assertEqual((computed.returncode, computed.stdout), (0, "(3, 50, 1)\n"), computed.stderr)

    def test_listens_to_an_array_without_a_library_and_to_a_file_with_that_of_the_computer(self):
        program = (
            "import earshot, numpy, wave\n"
            "x = numpy.random.default_rng(1).integers(-500, 500, 30_000).astype('int16')\n"
            "with wave.open('a.wav', 'wb') as f: f.setparams((1, 2, 1000, 0, 'NONE', '')); f.writeframes(x.tobytes())\n"
            "print(earshot.listen(x, 1000).listened_s)\n"
            "try: print(earshot.listen('a.wav').listened_s)\nexcept earshot.BadInput as bad: print(bad)"
        )
        both = self.python(program)
        self.assertEqual((both.returncode, both.stdout), (0, "30.0\n30.0\n"), both.stderr)
        (self.folder / "libsndfile.so.1").touch()  # the linker finds it before the computer's own, and cannot load it
        array_alone = self.python(program, LD_LIBRARY_PATH=str(self.folder))
        self.assertRegex(array_alone.stdout, "^30.0\n.*libsndfile .*apt install libsndfile1", array_alone.stderr)

    def test_says_what_to_install_where_there_is_no_netcdf(self):
        for name in ("libnetcdf.so.19", "libnetcdf.so.22"):
            (self.folder / name).touch()  # the linker finds it before the computer's own, and cannot load it
        read = self.python(
            "import earshot_gym\n"
            f"try: earshot_gym.make_world(environment={str(HILLY)!r})\nexcept ValueError as bad: print(bad)",
            LD_LIBRARY_PATH=str(self.folder),
        )
        self.assertRegex(read.stdout, "libnetcdf .*apt install libnetcdf19", read.stderr)

    def test_refuses_a_processor_that_it_was_not_built_for(self):
        program = (
            "from pathlib import Path; from earshot.processor import require; "
            "require(Path('built_for'), Path('cpuinfo'))"
        )
        (self.folder / "built_for").write_text("avx2 fma\n")
        (self.folder / "cpuinfo").write_text("processor\t: 0\nflags\t\t: fpu sse2 avx fma\n")
        refused = self.python(program)
        self.assertRegex(refused.stderr, "ImportError: .*processor with avx2,")
        (self.folder / "cpuinfo").write_text("flags\t\t: fpu avx2 fma\n")
        self.assertEqual(self.python(program).returncode, 0)


if __name__ == "__main__":
    del sys.argv[1:]
    os.umask(0o022)
    unittest.main()
