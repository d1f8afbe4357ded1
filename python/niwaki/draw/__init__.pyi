from . import animation as animation
from . import files as files
from . import picture as picture
from . import sheet as sheet
