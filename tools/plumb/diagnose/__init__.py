"""What the marks prove: slips, suspects, and what could still hide."""

from plumb.diagnose.diagnosis import VERDICTS, Diagnosis, diagnose
from plumb.fit.problem import Checked

__all__ = ["VERDICTS", "Checked", "Diagnosis", "diagnose"]
