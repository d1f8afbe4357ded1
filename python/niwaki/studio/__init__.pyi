from .client import Studio as Studio
from .client import StudioError as StudioError
from .client import connect as connect
from .serving import serve as serve
