"""Reads, checks, corrects and writes cutter-location data; motions and loads are arrays of numpy.

>>> import clsmith
>>> program = clsmith.read(b"FEDRAT/MMPM,800.\\nGOTO/0,0,0\\nGOTO/9,0,0\\n")
>>> program.motions().points[-1].tolist()
[9.0, 0.0, 0.0]
"""

from clsmith._clsmith import (
    KINDS,
    Correction,
    Editor,
    Engagement,
    Finding,
    Motions,
    Place,
    Program,
    Simulation,
    __version__,
    apply,
    engagement,
    read,
    simulate,
)
from clsmith._errors import ClsmithError

__all__ = [
    "KINDS",
    "ClsmithError",
    "Correction",
    "Editor",
    "Engagement",
    "Finding",
    "Motions",
    "Place",
    "Program",
    "Simulation",
    "__version__",
    "apply",
    "engagement",
    "read",
    "simulate",
]
