"""Diagnosis of marks: outliers, suspects, and effects that could still hide."""

from plumb.diagnosis.answer import VERDICTS, Diagnosis
from plumb.diagnosis.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.fit.problem import Checked

__all__ = ["VERDICTS", "Checked", "Diagnosis", "Inputs", "diagnose"]
