"""`earshot.annotations`: tables read, and scores as the program gives them.

Run by ctest (run in this folder).
"""

import pickle
import unittest
import warnings

import numpy as np
import pandas
from listening_cases import Cases, in_steps, song, write_wav

import earshot
import earshot.annotations


class Annotations(Cases):
    RAVEN = (
        "Selection\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq (Hz)\n1\t12\t13\t15\t25\n2\t40\t41\t18\t22\n"
    )

    def test_are_read(self):
        file = self.folder / "t.txt"
        file.write_text(self.RAVEN)
        table = earshot.annotations.read(file)
        self.assertEqual(
            table[["begin_s", "end_s", "low_hz", "high_hz"]].values.tolist(), [[12, 13, 15, 25], [40, 41, 18, 22]]
        )
        self.assertTrue(table["channel"].isna().all() and table["file_offset_s"].isna().all())
        file.write_text("start,end,label\n1.5,2.5,fin\n")
        labels = earshot.annotations.read(file)
        self.assertEqual(labels["end_s"].tolist(), [2.5])
        self.assertTrue(labels["low_hz"].isna().all())
        file.write_text("Begin Time (s)\tEnd Time (s)\n")
        self.assertEqual(len(earshot.annotations.read(file)), 0)

    def test_are_refused_with_file_line_and_key(self):
        file = self.folder / "t.txt"
        file.write_text(self.RAVEN.replace("\t41\t", "\t39\t"))
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.annotations.read(file)
        self.assertEqual((caught.exception.file, caught.exception.line), (str(file), 3))
        self.assertRaises(TypeError, earshot.annotations.read, 3)
        self.assertRaises(earshot.BadInput, earshot.annotations.read, self.folder / "nowhere.txt")

    def test_score_as_the_program_does(self):
        samples = in_steps(song(60, [12, 30, 48]), np.int16)
        file, truth = write_wav(self.folder / "a.wav", samples), self.folder / "t.txt"
        truth.write_text(self.RAVEN)
        found, _ = self.program(file, "--score", truth)
        heard = earshot.listen(file)
        expected = {name: value for name, value in found["score"].items() if name != "tolerance_s"}
        self.assertEqual((expected["hits"], expected["misses"], expected["false_alarms"]), (1, 1, 2))
        self.assertEqual(earshot.annotations.score(heard, truth).__dict__, expected)
        table = earshot.annotations.read(truth)
        for detections in (heard, pickle.loads(pickle.dumps(heard)), earshot.listen(samples, 1000)):
            self.assertEqual(earshot.annotations.score(detections, table).__dict__, expected)
        alone = earshot.annotations.score(heard.detections, table[["begin_s", "end_s"]], listened_s=heard.listened_s)
        self.assertEqual(alone.__dict__, expected)
        # 8 s from the end of the detection at 30 s to the begin of the selection at 40 s, nearly.
        self.assertEqual(earshot.annotations.score(heard, truth, tolerance_s=10.0).hits, 2)

    def test_score_in_the_files_that_they_name(self):
        names = ["a_20200912_000000.wav", "b_20200912_000200.wav"]
        files = [write_wav(self.folder / n, in_steps(song(60, [20 + 10 * i]), np.int16)) for i, n in enumerate(names)]
        truth = self.folder / "t.txt"
        truth.write_text(
            f"Begin File\tBegin Time (s)\tEnd Time (s)\n{names[1]}\t30\t31\n{names[0]}\t50\t51\nz.wav\t2\t3\n"
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            heard = earshot.listen(files)
            found, _ = self.program(*files, "--score", truth)
        with self.assertWarnsRegex(earshot.RecordingWarning, "1 of its selections are not counted"):
            score = earshot.annotations.score(heard, truth)
        self.assertEqual((score.selections, score.hits), (2, 1))
        self.assertEqual(score.__dict__, {n: v for n, v in found["score"].items() if n != "tolerance_s"})
        truth.write_text(f"Begin File\tBegin Time (s)\tEnd Time (s)\n{names[1]}\t300\t301\n")
        with self.assertRaisesRegex(earshot.BadInput, "neither") as caught:
            earshot.annotations.score(heard, truth)
        self.assertEqual(caught.exception.key, "truth")

    def test_are_refused_where_they_cannot_be_scored(self):
        heard = earshot.listen(song(60, [12]), 1000)
        good = pandas.DataFrame({"begin_s": [12.0], "end_s": [13.0]})
        for key, arguments, named in (
            ("truth", (heard, good.drop(columns="end_s")), {}),
            ("truth", (heard, good.assign(end_s=3.0)), {}),
            ("truth", (heard, good.assign(begin_s=np.nan)), {}),
            ("truth", (heard, good.assign(begin_s="noon")), {}),
            ("truth", (heard, good.assign(low_hz=900.0, high_hz=950.0)), {}),
            ("truth", (heard, good.assign(channel=3)), {}),
            ("path", (heard, 3), {}),
            ("detections", (3, good), {}),
            ("listened_s", (good, good), {}),
            ("listened_s", (good, good), {"listened_s": -1.0}),
            ("listened_s", (heard, good), {"listened_s": 60.0}),
            ("tolerance_s", (heard, good), {"tolerance_s": -1.0}),
            ("tolerance_s", (heard, good), {"tolerance_s": np.nan}),
        ):
            with self.assertRaises(earshot.BadInput) as caught:
                earshot.annotations.score(*arguments, **named)
            self.assertEqual(caught.exception.key, key, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
