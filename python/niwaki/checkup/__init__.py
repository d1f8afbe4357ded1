"""A look at an installation: what is there, what works, and what is missing for what.

doctor    all of it, as `niwaki doctor` prints it
trials    what a search needs, tried by small searches
report    what was found, as text and as JSON
"""

from niwaki.checkup.looking import doctor
from niwaki.checkup.report import Checkup, Extra, Trial

__all__ = ["Checkup", "Extra", "Trial", "doctor"]
