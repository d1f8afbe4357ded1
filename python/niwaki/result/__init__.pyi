from . import diagnostics as diagnostics
from .invalid import Invalid as Invalid
from .progress import Progress as Progress
from .progress import Watch as Watch
from .result import Result as Result
from .result import caption as caption
from .sample import Sample as Sample
