from .goals import Goal as Goal
from .goals import Outcome as Outcome
from .goals import number as number
from .loop import Failure as Failure
from .loop import FitLoop as FitLoop
from .loop import Point as Point
from .space import Parameter as Parameter
from .space import Space as Space
