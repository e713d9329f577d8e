"""The same results for a machine: JUnit's XML, which CI servers read."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from bench_results import CaseResult
from markup import printable

SUITE = "earshot bench"
CLASS = "hil.bench"


def _case(suite: ET.Element, result: CaseResult) -> None:
    case = ET.SubElement(suite, "testcase", name=printable(result.name), classname=CLASS, time=f"{result.wall_s:.3f}")
    if not result.passed:
        wrong = [printable(what) for what in result.wrong]
        ET.SubElement(case, "failure", message=wrong[0], type="verdict").text = "\n".join(wrong)
    story = f"GIVEN {result.given}\nWHEN {result.when}\nTHEN {result.then}\n"
    faults = "".join(f"{fault}\n" for fault in result.faults)
    ET.SubElement(case, "system-out").text = printable(story + faults + f"End of the mission: {result.end}\n")


def junit_report(results: list[CaseResult], not_flown: list[str]) -> bytes:
    """A suite of one testcase a case; its time is that of the bench, not that at sea.

    @param not_flown  names of cases that were to be flown, too
    """
    totals = {
        "name": SUITE,
        "tests": str(len(results) + len(not_flown)),
        "failures": str(sum(not result.passed for result in results)),
        "errors": "0",
        "skipped": str(len(not_flown)),
        "time": f"{sum(result.wall_s for result in results):.3f}",
    }
    root = ET.Element("testsuites", totals)
    suite = ET.SubElement(root, "testsuite", totals)
    for result in results:
        _case(suite, result)
    for name in not_flown:
        case = ET.SubElement(suite, "testcase", name=printable(name), classname=CLASS)
        ET.SubElement(case, "skipped", message="not flown")
    ET.indent(root)
    return ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"
