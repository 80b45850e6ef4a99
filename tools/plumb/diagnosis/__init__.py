"""Diagnosis of marks: outliers, suspects, and effects that could still hide."""

from plumb.diagnosis.diagnosis import VERDICTS, Diagnosis, diagnose
from plumb.fit.fit import Checked
from plumb.fit.inputs import Inputs

__all__ = ["VERDICTS", "Checked", "Diagnosis", "Inputs", "diagnose"]
