"""A report on an installation: versions, tests of the core, the machine, and the extras.

| module | contents |
| --- | --- |
| `inspection` | `doctor`, which makes the report |
| `trials` | small searches that test the core |
| `report` | the report as values, as text and as JSON |
"""

from niwaki.checkup.inspection import doctor
from niwaki.checkup.report import Checkup, Extra, Trial

__all__ = ["Checkup", "Extra", "Trial", "doctor"]
