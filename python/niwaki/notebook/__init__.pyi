from .viewer import View as View
from .viewer import view as view
