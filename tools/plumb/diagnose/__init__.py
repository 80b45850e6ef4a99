"""What the marks prove: slips, suspects, and what could still hide."""

from plumb.diagnose.diagnosis import VERDICTS, Diagnosis, diagnose

__all__ = ["VERDICTS", "Diagnosis", "diagnose"]
