"""How `pio test -e native` ends: a test that falls is a failure of its suite, and nothing else."""

import importlib.util
from pathlib import Path

import pytest
from platformio.test import result
from platformio.test.exception import UnitTestError
from platformio.test.runners.googletest import GoogletestTestRunner

RUNNER = Path(__file__).resolve().parents[3] / "test/test_custom_runner.py"
HANGUP = "Program received signal SIGHUP (Hangup)"


@pytest.fixture
def suite_that(monkeypatch):
    """Runs a suite whose only test ended so, and whose program ended with this error."""
    spec = importlib.util.spec_from_file_location("custom_runner", RUNNER)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)

    def end(status, error):
        def stage_testing(_):
            raise UnitTestError(error)

        monkeypatch.setattr(GoogletestTestRunner, "stage_testing", stage_testing)
        runner = module.CustomTestRunner.__new__(module.CustomTestRunner)
        runner.test_suite = result.TestSuite("native", "test_gcode")
        runner.test_suite.add_case(result.TestCase("Input.GivesLines", status))
        runner.stage_testing()

    return end


def test_exit_code_1_after_a_test_that_fell_is_no_signal(suite_that):
    suite_that(result.TestStatus.FAILED, HANGUP)


@pytest.mark.parametrize(
    ("status", "error"),
    [
        (result.TestStatus.PASSED, HANGUP),
        (result.TestStatus.FAILED, "Program received signal SIGSEGV (Segmentation fault)"),
    ],
)
def test_any_other_end_is_an_error(suite_that, status, error):
    with pytest.raises(UnitTestError):
        suite_that(status, error)
