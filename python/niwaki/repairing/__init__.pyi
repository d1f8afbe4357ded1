from .entry import repair as repair
from .result import Conflict as Conflict
from .result import Patch as Patch
from .result import Repair as Repair
from .scripts import Output as Output
