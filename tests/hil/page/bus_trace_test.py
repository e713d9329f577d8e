"""Which frames are shown, and between which remarks."""

import re
import unittest

from bench_example import ROOT, calm, deaf, results_of

from bus_trace import MOST_FRAMES, frames_around, trace_html
from group_names import pgn_of, read_group_names


def rows(html: str) -> list[str]:
    return [re.sub(r"<[^>]+>", "|", row) for row in re.findall(r"<tr>(.*?)</tr>", html)][1:]


class FramesAround(unittest.TestCase):
    def test_the_first_rule_are_those_from_3_s_before_to_1_s_after_it(self):
        (case,) = results_of(deaf())
        words, frames = frames_around(case)
        self.assertEqual([frame.time_s for frame in frames], [597.0, 600.0, 601.0])
        self.assertRegex(words, r"^3 of 5 frames .*\(leak\): 597 s to 601 s")

    def test_no_rule_are_the_last(self):
        (case,) = results_of(deaf() | {"events": []})
        words, frames = frames_around(case)
        self.assertEqual([frame.time_s for frame in frames], [600.0, 601.0, 602.0])
        self.assertIn("at the end", words)

    def test_a_rule_that_fired_before_the_trace_began_are_the_last_and_this_is_said(self):
        trace = [frame | {"time_s": 1700.0} for frame in deaf()["trace"]]
        (case,) = results_of(deaf() | {"trace": trace})
        words, frames = frames_around(case)
        self.assertEqual(len(frames), 5)
        self.assertIn("The trace begins at 1700 s, after that", words)

    def test_a_moment_are_the_nearest_where_they_are_too_many(self):
        frame = deaf()["trace"][0]
        trace = [frame | {"time_s": time} for time in [597.0] * MOST_FRAMES + [600.0] * (MOST_FRAMES - 10)]
        (case,) = results_of(deaf() | {"trace": trace})
        times = [frame.time_s for frame in frames_around(case)[1]]
        self.assertEqual(times, [597.0] * 10 + [600.0] * (MOST_FRAMES - 10))

    def test_nothing_where_there_is_no_trace(self):
        (case,) = results_of(calm() | {"trace": []})
        self.assertIn("There is no trace of the bus.", trace_html(case, {}))


class Trace(unittest.TestCase):
    def test_names_the_channel_of_a_message_over_lcm(self):
        message = {"time_s": 600.0, "from_earshot": True, "pgn": 0, "source": 0, "data": "4c43", "channel": "A<B"}
        (case,) = results_of(deaf() | {"bus": "LCM", "trace": [message]})
        self.assertIn("1 of 1 messages that were kept", trace_html(case, {}))
        self.assertIn(">channel</th>", trace_html(case, {}))
        self.assertIn("|600||Earshot||A&lt;B|||4c 43||", "".join(rows(trace_html(case, {0: "ISO"}))))

    def test_has_faults_before_the_frames_of_their_second_and_rules_behind(self):
        fault = {"words": "loss of all", "from_s": 600.0, "until_s": 5000.0}
        (case,) = results_of(deaf() | {"faults": [fault]})
        told = rows(trace_html(case, {65291: "EarshotSNR"}))
        self.assertEqual(len(told), 5)
        self.assertIn("|fault begins|", told[1])
        self.assertIn("65291 EarshotSNR", told[2])
        self.assertIn("|rule fires|", told[3])
        self.assertIn("leak, 1 (limit \N{EN DASH}): release", told[3])

    def test_says_who_sent_a_frame(self):
        (case,) = results_of(calm())
        told = rows(trace_html(case, {}))
        self.assertIn("|vehicle 36|", told[0])
        self.assertIn("c6 8e 3d ff 7f ff 7f fc", told[0])
        self.assertIn("|Earshot 64|", told[1])


class GroupNames(unittest.TestCase):
    def test_are_those_of_the_dbc_file(self):
        names = read_group_names(ROOT / "hil/bus/earshot.dbc")
        for pgn, name in {127250: "VesselHeading", 65290: "EarshotSpeedDepth", 60928: "ISOAddressClaim"}.items():
            self.assertEqual(names[pgn], name)

    def test_leave_a_receivers_address_out(self):
        # Of NMEA 2000's printed examples: 127250 with priority 2 of address 0x23; 59904 with priority 6 to all.
        self.assertEqual(pgn_of(0x89F11223), 127250)
        self.assertEqual(pgn_of(0x98EAFF23), 59904)

    def test_are_none_without_a_file(self):
        self.assertEqual(read_group_names(ROOT / "no.dbc"), {})


if __name__ == "__main__":
    unittest.main()
