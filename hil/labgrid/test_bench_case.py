"""A case of Earshot's bench as a test of a lab: pytest --lg-env hil/labgrid/this_computer.yaml hil/labgrid"""

import pytest


@pytest.fixture
def bench(target):
    return target.get_driver("EarshotBenchDriver")


@pytest.mark.parametrize("case", ["compass_lost"])
def test_case_passes(bench, case):
    assert bench.fly(case) == []


def test_a_case_that_is_not_there_is_told(bench):
    with pytest.raises(Exception, match="there is no .*no_such_case.toml"):
        bench.fly("no_such_case")
