from . import animation as animation
from . import files as files
from . import flat as flat
from . import glb as glb
from . import picture as picture
from . import reuse as reuse
from . import sheet as sheet
from . import solid as solid
