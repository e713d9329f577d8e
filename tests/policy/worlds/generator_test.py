"""Oceans and worlds that are drawn. usage: generator_test.py FOLDER_OF_PROGRAMS"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "policy/worlds/generator"))
import generate
import oceans
import sea_beds
import waters
from draws import Draws, van_der_corput
from searches import Conditions, drawn_conditions
from variants import variants

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = Path(sys.argv.pop())
PAPERS = ROOT / "sim/ocean/environments/munk_flat.toml"
TEST_SPLIT = ROOT / "policy/worlds/test"


class Numbers(unittest.TestCase):
    def test_a_seed_gives_the_number_that_it_gave_when_the_test_split_was_drawn(self):
        # random.Random("3000000/1").random() of Python 3.11.7.
        self.assertEqual(Draws("3000000/1").fraction(), 0.18026227754100277)

    def test_points_of_a_design_mirror_the_digits_of_their_number(self):
        self.assertEqual([van_der_corput(i, 2) for i in range(5)], [0, 0.5, 0.25, 0.75, 0.125])
        self.assertAlmostEqual(van_der_corput(5, 3), 2 / 3 + 1 / 9)  # 12 in base 3

    def test_a_logarithmic_draw_lies_as_often_below_the_geometric_middle_as_above(self):
        draws = Draws("middle")
        values = [draws.log_uniform(60, 6000) for _ in range(2000)]
        self.assertTrue(min(values) >= 60 and max(values) <= 6000)
        self.assertAlmostEqual(sum(v < 600 for v in values) / 2000, 0.5, delta=0.05)  # 4.5 standard deviations


class Variants(unittest.TestCase):
    def setUp(self):
        self.told = tomllib.loads(PAPERS.read_text())
        self.variants = {name: tomllib.loads(text) for name, text in variants(PAPERS.read_text()).items()}

    def differing(self, name):
        """Tables that differ from those of what is told, but for its name."""
        return [key for key in self.told if key != "name" and self.variants[name][key] != self.told[key]]

    def test_each_differs_in_one_thing_alone(self):
        self.assertEqual(len(self.variants), 9 + 4 + 6)
        for name, ocean in self.variants.items():
            if name.startswith("over_"):
                self.assertEqual(self.differing(name), ["seabed"])
            elif name.startswith("in_"):
                self.assertEqual(self.differing(name), ["water", "seabed"])
            else:
                self.assertEqual(self.differing(name), ["source"])
            self.assertEqual(ocean["seabed"]["depth_m"], 3000, name)

    def test_a_sea_floor_is_as_much_faster_than_the_water_above_it_as_printed(self):
        # Munk at 3000 m: eta = 2 (3000 - 1300) / 1300 = 2.61538,
        # c = 1500 (1 + 0.00737 (1.61538 + 0.07314)) = 1518.67 m/s.
        layer = {"sound_speed_mps": 3037.3, "density_g_per_cm3": 2.4, "attenuation_db_per_wavelength": 0.1}
        self.assertEqual(self.variants["over_limestone"]["seabed"]["layers"], [layer])

    def test_other_water_lies_over_the_same_sea_floor(self):
        # Told: 1505 / 1518.67 of the water's sound speed; polar water there has 1502.9 m/s.
        layer = self.variants["in_polar_water"]["seabed"]["layers"][0]
        self.assertAlmostEqual(layer["sound_speed_mps"], 1505 / 1518.67 * 1502.9, delta=0.1)
        self.assertEqual(layer["density_g_per_cm3"], 1.5)

    def test_a_source_is_put_at_every_depth_but_the_one_told_and_none_below_the_sea_floor(self):
        shallow = (
            PAPERS.read_text()
            .replace("depth_m = 3000.0", "depth_m = 120.0")
            .replace("depth_m = 30.0", "depth_m = 20.0")
        )
        depths = [
            tomllib.loads(text)["source"]["depth_m"] for name, text in variants(shallow).items() if "source" in name
        ]
        self.assertEqual(depths, [10, 60, 100])

    def test_a_table_is_read_between_its_depths(self):
        water = (
            '[water]\nprofile = "table"\ndepth_m = [0.0, 2000.0, 4000.0]\nsound_speed_mps = [1500.0, 1490.0, 1530.0]\n'
        )
        text = re.sub(r"(?s)\[water\].*?\[seabed\]", lambda _: water + "[seabed]", PAPERS.read_text())
        layer = tomllib.loads(variants(text)["over_limestone"])["seabed"]["layers"][0]
        self.assertEqual(layer["sound_speed_mps"], 3020.0)  # twice 1510

    def test_an_ocean_of_several_layers_or_oceans_has_none(self):
        two_layers = PAPERS.read_text() + "[[seabed.layers]]\nsound_speed_mps = 1600.0\n"
        for text, complaint in [(two_layers, "2 of them"), (PAPERS.read_text() + "[family]\n", "family")]:
            with self.assertRaisesRegex(ValueError, complaint):
                variants(text)


class Waters(unittest.TestCase):
    MIDDLE = (0.5, 0.5, 0.5)

    def test_sound_speed_is_mackenzies(self):
        # The check value of his paper: 25 C, 35 psu, 1000 m.
        self.assertAlmostEqual(waters.sound_speed_mps(25, 35, 1000), 1550.744, places=3)

    def test_munk_is_the_papers(self):
        munk = waters.Munk(axis_sound_speed_mps=1500, axis_depth_m=1300, perturbation=0.00737)
        self.assertEqual(munk.sound_speed_mps(1300), 1500)
        # At the surface eta is -2: 1500 (1 + 0.00737 (e^2 - 3)).
        self.assertAlmostEqual(munk.sound_speed_mps(0), 1548.52, places=2)

    def test_polar_water_bends_sound_up_at_every_depth(self):
        for shape in [(0.0, 0.0, 0.0), self.MIDDLE, (1.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]:
            speeds = [speed for _, speed in waters.table(waters.Water("polar", shape), 6000)]
            self.assertEqual(speeds, sorted(set(speeds)), shape)

    def test_winter_has_a_duct_at_the_surface_and_summer_none_below_its_warm_layer(self):
        winter = waters.profile(waters.Water("winter", self.MIDDLE))
        summer = waters.profile(waters.Water("summer", self.MIDDLE))
        self.assertLess(winter(0), winter(200))
        self.assertGreater(summer(30), summer(60) + 5)
        self.assertGreater(winter(300), winter(700))  # the thermocline that lasts

    def test_every_water_is_within_what_is_measured_at_sea(self):
        for kind in waters.KINDS:
            for shape in [(0.0, 0.0, 0.0), self.MIDDLE, (1.0, 1.0, 1.0)]:
                for depth, speed in waters.table(waters.Water(kind, shape), 6000):
                    self.assertTrue(1430 < speed < 1640, (kind, shape, depth, speed))

    def test_a_table_reaches_from_the_surface_to_the_sea_floor(self):
        for floor in [60, 61, 300, 5999, 6000]:
            depths = [depth for depth, _ in waters.table(waters.Water("summer", self.MIDDLE), floor)]
            self.assertEqual((depths[0], depths[-1]), (0, floor))
            self.assertEqual(depths, sorted(set(depths)))


class SeaBeds(unittest.TestCase):
    def test_the_scale_runs_from_mud_to_basalt(self):
        self.assertEqual(sea_beds.bed_at(0.0).name, "soft mud")
        self.assertEqual(sea_beds.bed_at(1.0), sea_beds.Bed("basalt", 3.5, 2.7, 0.1))
        self.assertEqual(sea_beds.bed_at(3 / 8), sea_beds.Bed("sand", 1.1, 1.9, 0.8))

    def test_between_two_neighbours_lies_what_is_between_them(self):
        # Half way from limestone to basalt.
        self.assertEqual(sea_beds.bed_at(7.5 / 8), sea_beds.Bed("basalt", 2.75, 2.55, 0.1))


class Bank(unittest.TestCase):
    def test_its_first_thirty_hold_every_water_sea_floor_and_depth_alike(self):
        bank = [oceans.bank_ocean(i, 20.0) for i in range(30)]
        self.assertEqual(Counter(o.water.kind for o in bank), dict.fromkeys(waters.KINDS, 6))
        shallow = sum(o.floor_m < 600 for o in bank)
        self.assertEqual(shallow, 15)
        thirds = Counter(int(3 * van_der_corput(i + 1, 3)) for i in range(30))
        self.assertEqual(thirds, {0: 10, 1: 10, 2: 10})
        self.assertLess(min(o.floor_m for o in bank), 80)
        self.assertGreater(max(o.floor_m for o in bank), 4000)

    def test_every_water_meets_shallow_and_deep_hard_and_soft(self):
        cells = {
            (o.water.kind, o.floor_m < 600, o.bed.speed_ratio < 1.15)
            for o in (oceans.bank_ocean(i, 20.0) for i in range(60))
        }
        self.assertEqual(len(cells), 5 * 2 * 2)


class Worlds(unittest.TestCase):
    def test_no_two_splits_can_share_a_seed(self):
        first = sorted(generate.FIRST_SEED.values())
        self.assertEqual(len(first), 3)
        for lower, upper in zip(first, first[1:], strict=False):
            self.assertLessEqual(lower + generate.MOST_WORLDS, upper)

    def test_the_number_of_a_world_alone_decides_what_it_is(self):
        self.assertEqual(generate.world_files("train", 7, 1), generate.world_files("train", 7, 1))
        texts = {
            generate.world_files(split, 7, draw)[f"{split}_007.toml"]
            for split in generate.FIRST_SEED
            for draw in (1, 2)
        }
        self.assertEqual(len({text.split("what")[1] for text in texts}), 6)

    def test_a_world_says_what_it_is_in_the_keys_of_its_files(self):
        for index in range(200):
            files = generate.world_files("train", index, 1)
            name = f"train_{index:03d}"
            world, ocean = (tomllib.loads(files[file]) for file in (f"{name}.toml", f"oceans/{name}.toml"))
            self.assertEqual((world["name"], world["seed"]), (name, 1_000_000 + index))
            self.assertEqual(world["environment"], f"oceans/{name}.toml")
            floor = ocean["seabed"]["depth_m"]
            self.assertTrue(60 <= floor <= 6000)
            self.assertLess(world["vehicle_depth_m"], floor)
            self.assertLess(ocean["source"]["depth_m"], floor)
            self.assertTrue(
                all(line.startswith(generate.MADE_BY) for line in (text.split("\n")[0] for text in files.values()))
            )

    def test_draws_reach_all_that_is_promised(self):
        drawn = [(oceans.drawn_ocean(d), drawn_conditions(d)) for d in (Draws(f"{i}") for i in range(1000))]
        ocean, met = zip(*drawn, strict=True)
        self.assertEqual({o.water.kind for o in ocean}, set(waters.KINDS))
        self.assertEqual({o.bed.name for o in ocean}, {bed.name for bed in sea_beds.SCALE})
        self.assertAlmostEqual(
            sum(o.frequency_hz == 20.0 for o in ocean) / 1000, 0.5, delta=0.07
        )  # 4.4 standard deviations
        for happens, share in [
            (lambda c: c.pauses, 0.3),
            (lambda c: c.current, 0.3),
            (lambda c: c.source_speed_mps, 0.3),
        ]:
            self.assertAlmostEqual(sum(bool(happens(c)) for c in met) / 1000, share, delta=0.06)
        self.assertTrue(all(o.vehicle_depth_m <= 300 for o in ocean))
        # What covers the sea floor is softer than what lies below it.
        self.assertTrue(all(o.cover.bed.speed_ratio <= o.bed.speed_ratio for o in ocean if o.cover))

    def test_what_fluctuates_more_is_measured_less_far_down(self):
        calm = Conditions(2, 0, 0, 0, 1, None, None)
        self.assertEqual(calm.floor_db, 3.0)  # as in most worlds
        self.assertEqual(Conditions(4, 0, 0, 0, 1, None, None).floor_db, 5.0)  # noisy_4db
        self.assertEqual(Conditions(8, 0, 0, 0, 1, None, None).floor_db, 10.0)  # noisy_8db


class TestSplit(unittest.TestCase):
    def test_it_is_what_the_generator_draws(self):
        worlds = sorted(TEST_SPLIT.glob("*.toml"))
        self.assertEqual([world.stem for world in worlds], [f"test_{i:03d}" for i in range(40, 80)])
        self.assertEqual(len(list(TEST_SPLIT.rglob("*.*"))), 80)
        for index, world in enumerate(worlds, 40):
            draw = re.search(r"\(draw (\d+)\)", world.read_text())
            assert draw
            for name, text in generate.world_files("test", index, int(draw.group(1))).items():
                self.assertEqual((TEST_SPLIT / name).read_text(), text, name)


class WritingWorlds(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.out = Path(self.folder.name) / "worlds"

    def refusing(self, *answers: str | None):
        """Answers in turn whether a world is refused."""
        left = list(answers)
        return lambda *_: left.pop(0)

    def run_generate(self, *words: object) -> subprocess.CompletedProcess[str]:
        command = [ROOT / "policy/worlds/generate", *words, "--bin", PROGRAMS]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)

    def contents(self) -> dict[str, str]:
        return {str(file.relative_to(self.out)): file.read_text() for file in self.out.rglob("*") if file.is_file()}

    def test_what_is_refused_is_drawn_again_and_the_file_says_which_draw_it_is(self):
        generate.write_world("train", 4, self.out, self.refusing("the solver says no", None))
        self.assertEqual(self.contents(), generate.world_files("train", 4, 2))

    def test_what_is_held_is_in_every_world_and_the_rest_is_as_it_was_drawn(self):
        drawn = generate.world_files("train", 4, 1)
        held = generate.world_files("train", 4, 1, generate.Held(frequency_hz=21.5, vehicle_depth_m=40))
        ocean, world = held["oceans/train_004.toml"], held["train_004.toml"]
        self.assertIn("\nfrequency_hz = 21.5\n", ocean)
        self.assertIn("\nvehicle_depth_m = 40.0\n", world)
        self.assertIn("--count 1 --frequency-hz 21.5 --vehicle-depth-m 40 (draw 1)", world)
        for name in drawn:  # but for the sentences that say both

            def rest(text: str) -> list[str]:
                named = ("#", "name", "what", "frequency_hz", "vehicle_depth_m")
                return [line for line in text.splitlines() if not line.startswith(named)]

            self.assertEqual(rest(held[name]), rest(drawn[name]))

    def test_water_that_a_vehicle_held_that_deep_does_not_fit_into_is_drawn_again(self):
        held = ("--frequency-hz", 20, "--vehicle-depth-m", 300)
        done = self.run_generate("--split", "train", "--count", 1, "--first", 6, *held, "-o", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("train_006: drawn again", done.stderr)  # 285 m of water
        world = tomllib.loads((self.out / "train_006.toml").read_text())
        ocean = tomllib.loads((self.out / "oceans/train_006.toml").read_text())
        self.assertEqual((world["vehicle_depth_m"], ocean["source"]["frequency_hz"]), (300.0, 20.0))
        self.assertGreater(ocean["seabed"]["depth_m"], 300.0)

    def test_a_point_of_the_bank_that_is_refused_is_left_out(self):
        generate.write_bank(2, 20.0, self.out, self.refusing(None, "no", None))
        self.assertEqual(sorted(self.contents()), ["bank.csv", "bank_000.toml", "bank_002.toml"])
        self.assertEqual(
            self.contents()["bank.csv"], "environment,vehicle_depth_m\nbank_000.toml,300\nbank_002.toml,300\n"
        )

    def test_a_world_that_is_drawn_can_be_searched_in(self):
        done = self.run_generate("--split", "train", "--count", 1, "--first", 2, "-o", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(self.contents()), ["oceans/train_002.toml", "train_002.toml"])

    def test_a_world_of_which_a_program_says_no_is_refused_in_its_words(self):
        generate.write(self.out, generate.world_files("train", 4, 1))
        world = self.out / "train_004.toml"
        world.write_text(world.read_text().replace("fluctuation_db = ", "fluctuation_db = -"))
        self.assertIn("fluctuation_db", str(generate.solver.refuses_world(f"{PROGRAMS}/", world)))

    def test_a_source_that_nobody_hears_is_no_world_to_search_in(self):
        generate.write(self.out, generate.world_files("train", 4, 1))
        ocean = self.out / "oceans/train_004.toml"
        ocean.write_text(re.sub(r"level_db_re_1upa = .*", "level_db_re_1upa = 200.0", ocean.read_text()))
        self.assertIn("heard at 0.0 %", str(generate.solver.refuses_world(f"{PROGRAMS}/", self.out / "train_004.toml")))

    def test_only_a_folder_of_its_own_is_replaced_and_that_only_with_force(self):
        self.out.mkdir()
        (self.out / "letter.txt").write_text("mine")
        done = self.run_generate("--bank", 1, "--force", "-o", self.out)
        self.assertIn("not made here", done.stderr)
        self.assertEqual(self.contents(), {"letter.txt": "mine"})
        (self.out / "letter.txt").unlink()
        self.assertEqual(self.run_generate("--bank", 1, "-o", self.out).returncode, 0)
        self.assertIn("--force", self.run_generate("--bank", 2, "-o", self.out).stderr)
        self.assertEqual(self.run_generate("--bank", 2, "--force", "-o", self.out).returncode, 0)
        self.assertEqual(sorted(self.contents()), ["bank.csv", "bank_000.toml", "bank_001.toml"])
        self.assertEqual([file.name for file in Path(self.folder.name).iterdir()], ["worlds"])

    def test_variants_are_written_for_earshot_to_read_and_one_of_no_ocean_is_refused(self):
        done = self.run_generate("--variants-of", PAPERS, "-o", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        for file in self.out.iterdir():
            self.assertIsNone(generate.solver.refuses_environment(f"{PROGRAMS}/", file, 300.0), file.name)
        for name, text, complaint in [
            ("none.toml", None, "No such file"),
            ("letter.toml", "Dear sea,", "letter.toml"),
            ("half.toml", 'name = "half"\n', "seabed.layers"),
            ("dry.toml", re.sub(r"(?s)\[water\].*?\[seabed\]", "[seabed]", PAPERS.read_text()), "lacks 'water'"),
        ]:
            file = Path(self.folder.name) / name
            if text is not None:
                file.write_text(text)
            done = self.run_generate("--variants-of", file, "-o", Path(self.folder.name) / "refused")
            self.assertEqual(done.returncode, 2, name)
            self.assertIn(f"--variants-of {file}", done.stderr)
            self.assertIn(complaint, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertFalse((Path(self.folder.name) / "refused").exists())

    def test_numbers_outside_a_split_are_refused(self):
        for words in [
            ("--split", "test", "--first", 999_990, "--count", 11),
            ("--split", "test", "--count", 0),
            ("--bank", 0),
            ("--bank", 2, "--vehicle-depth-m", 40),
            ("--variants-of", PAPERS, "--vehicle-depth-m", 40),
            ("--variants-of", PAPERS, "--bank", 2),
            ("--split", "train", "--vehicle-depth-m", 6000),
            ("--bank", 1, "--count", 5, "--first", 7),
            ("--variants-of", PAPERS, "--count", 5),
            ("--split", "test", "--frequency-hz", 20),
            ("--split", "validation", "--vehicle-depth-m", 40),
        ]:
            done = self.run_generate(*words, "-o", self.out)
            self.assertEqual(done.returncode, 2, words)
            self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
