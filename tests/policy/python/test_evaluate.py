"""`earshot.evaluate`: the program's figures, and policies that are written in Python.

Run by ctest (run in this folder).
"""

import csv
import itertools
import os
import signal
import subprocess
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path
from typing import Any

import pandas  # noqa: F401  a signal in the midst of its import would leave half of it
from third_tick import third_tick_interrupts

import earshot

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = os.environ["EARSHOT_PROGRAMS"]
SHIPPED = ROOT / "policy/tables/shipped/20hz_300m.tables"
FIXED = ROOT / "policy/frozen/fixed_source.policy"
THREE: Any = 3


def eastwards(position, snr, too_faint, step):
    return 2


class OfTheProgram(unittest.TestCase):
    def require_same(self, options, frame):
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "table.csv"
            subprocess.run(
                [f"{PROGRAMS}/earshot-evaluate", *map(str, options), "--csv", output], check=True, capture_output=True
            )
            rows = list(csv.DictReader(output.read_text().splitlines()))
        self.assertEqual(len(rows), len(frame))
        for i, row in enumerate(rows):
            ours = frame.iloc[i]
            for column, text in row.items():
                if column in ("world", "policy"):
                    self.assertEqual(ours[column], text)
                elif text == "":
                    self.assertTrue(ours[column] != ours[column], column)
                else:
                    self.assertEqual(float(ours[column]), float(text), column)

    def test_are_the_figures_of_the_papers_ocean(self):
        frame = earshot.evaluate(["sweep", "oracle", "bayes"], n=7, seed=5)
        # The program has tables that ship; none of these three asks for any.
        self.require_same(["--policies", "sweep,oracle,bayes", "--episodes", 7, "--seed", 5], frame)

    def test_are_the_figures_of_a_world_with_tables(self):
        world = ROOT / "policy/worlds/noisy_4db.toml"
        frame = earshot.evaluate("ocean_search", world, n=3, tables=SHIPPED, declared=True)
        options = ["--policies", "ocean_search", "--world", world, "--tables", SHIPPED, "--episodes", 3, "--declared"]
        self.require_same(options, frame)

    def test_are_the_figures_of_a_policy_as_it_was_trained(self):
        frame = earshot.evaluate(FIXED, n=5)
        self.require_same([FIXED, "--episodes", 5], frame)


class InPython(unittest.TestCase):
    def test_sees_where_it_is_and_what_it_hears(self):
        seen = []

        def policy(position, snr, too_faint, step):
            seen.append((position, snr, too_faint, step))
            return 2

        frame = earshot.evaluate(policy, n=1, seed=3)
        self.assertEqual(frame.policy[0], "policy")
        self.assertEqual([place[3] for place in seen], list(range(len(seen))))
        for (north, east), (then_north, then_east) in itertools.pairwise(s[0] for s in seen):
            self.assertAlmostEqual(then_north, north, places=6)
            self.assertAlmostEqual(then_east, east + 1_000.0, places=6)
        self.assertEqual(len(seen), frame.mean_steps[0])

    def test_meets_the_same_searches_as_earshots_own(self):
        class Adviser:
            """Hands on what the belief advises, by Earshot's own belief."""

            def begin(self, seed):
                self.belief = earshot.Belief(TABLES, border_width=1_000.0)

            def choose(self, position, snr, too_faint, step):
                self.belief.update(position, snr=snr, too_faint=too_faint)
                return int(self.belief.actions.regret.to_numpy().argmin())

            def declares_found(self):
                return self.belief.declaration is not None

        TABLES = earshot.Tables.from_file(SHIPPED)
        frame = earshot.evaluate([{"mine": Adviser()}, "ocean_search"], n=4, tables=TABLES, seed=11)
        mine, own = frame.iloc[0], frame.iloc[1]
        # ocean_search sweeps where its belief is mismatched; in these four searches it never is.
        for column in ("found_fraction", "mean_steps", "mean_reward", "mean_detections", "missed_fraction"):
            self.assertEqual(mine[column], own[column], column)

    def test_may_be_several_and_have_names(self):
        frame = earshot.evaluate({"a": eastwards, "b": eastwards}, n=3)
        self.assertEqual(frame.policy.tolist(), ["a", "b"])
        self.assertEqual(frame.mean_reward[0], frame.mean_reward[1])
        self.assertEqual(frame.attrs["units"]["median_hours_to_find"], "h")

    def test_passes_on_what_it_raises(self):
        def broken(position, snr, too_faint, step):
            raise ZeroDivisionError("mine")

        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            earshot.evaluate(broken, n=1)

    def test_must_choose_an_action(self):
        for wrong in (8, -1, 2.5, None, "north", 2**70):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(earshot.BadInput, "whole number, 0 to 7") as raised:
                earshot.evaluate({"mine": lambda *_, wrong=wrong: wrong}, n=1)
            self.assertEqual(raised.exception.key, "policies")

    def test_must_say_whether_it_declares(self):
        class Unsure:
            def choose(self, position, snr, too_faint, step):
                return 0

            def declares_found(self):
                return "perhaps"

        with self.assertRaisesRegex(
            earshot.BadInput, "declares_found of mine must give True or False, and gave 'perhaps'"
        ):
            earshot.evaluate({"mine": Unsure()}, n=1)

    def test_may_evaluate_others_but_not_without_end(self):
        def within(position, snr, too_faint, step):
            earshot.evaluate(within, n=1, max_steps=1)
            return 0

        with self.assertRaisesRegex(earshot.BadInput, "more than 8 deep"):
            earshot.evaluate(within, n=1, max_steps=1)

    def test_ends_at_ctrl_c(self):
        began = time.monotonic()
        shares: list[float] = []

        def told(share):
            if not shares:  # the search flies: an import that Ctrl-C ended would be missed by the tests that follow
                threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            shares.append(share)

        with self.assertRaises(KeyboardInterrupt):
            earshot.evaluate(eastwards, n=10_000_000, progress=told)
        self.assertEqual(shares, sorted(shares))
        self.assertLess(time.monotonic() - began, 60.0)

    def test_ends_at_ctrl_c_while_intervals_are_drawn_from_many_searches(self):
        n = 60_000

        class Counting:
            searches = 0

            def begin(self, seed):
                self.searches += 1
                if self.searches == n:
                    start()

            def choose(self, position, snr, too_faint, step):
                return 0

        policy = Counting()
        with third_tick_interrupts() as start, self.assertRaises(KeyboardInterrupt):
            earshot.evaluate([policy], n=n, max_steps=1)
        self.assertEqual(policy.searches, n)


class Refused(unittest.TestCase):
    def test_are_arguments_that_cannot_be(self):
        for key, wrong in {
            "policies": lambda: earshot.evaluate({}),
            "worlds": lambda: earshot.evaluate("sweep", THREE),
            "n": lambda: earshot.evaluate("sweep", n=0),
            "seed": lambda: earshot.evaluate("sweep", n=1, seed=-1),
            "source": lambda: earshot.evaluate("sweep", n=1, source="swimming"),
            "start": lambda: earshot.evaluate("sweep", n=1, start=THREE),
            "vehicle_depth": lambda: earshot.evaluate("sweep", n=1, vehicle_depth=5_000.0),
            "border_width": lambda: earshot.evaluate("sweep", n=1, border_width=-1.0),
            "max_steps": lambda: earshot.evaluate("sweep", n=1, max_steps=0),
            "tables": lambda: earshot.evaluate("sweep", n=1, tables=[]),
            "environment": lambda: earshot.evaluate("sweep", n=1, environment=THREE),
            "progress": lambda: earshot.evaluate("sweep", n=1, progress=THREE),
        }.items():
            with self.subTest(key=key), self.assertRaises(earshot.BadInput) as raised:
                wrong()
            self.assertEqual(raised.exception.key, key)
        refused: dict[str, Any] = {
            "twice": ["sweep", "sweep"],
            "^policies: nobody: neither a .policy file": ["nobody"],
            "a callable": [3],
        }
        for key, policies in refused.items():
            with self.subTest(key=key), self.assertRaisesRegex(earshot.BadInput, key):
                earshot.evaluate(policies, n=1)

    def test_is_a_world_that_no_tables_are_of(self):
        with self.assertRaisesRegex(earshot.BadInput, "tables: hz_35"):
            earshot.evaluate("ocean_search", ROOT / "policy/worlds/hz_35.toml", n=1, tables=SHIPPED)

    def test_warns_of_another_search_than_was_trained(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            earshot.evaluate(FIXED, n=1, source="changing")
        self.assertTrue(any(w.category is earshot.EvaluationWarning for w in caught))


if __name__ == "__main__":
    unittest.main()
