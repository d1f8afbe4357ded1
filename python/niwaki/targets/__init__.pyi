from . import drawing as drawing
from . import drawings as drawings
from . import examples as examples
from . import fit as fit
from . import images as images
from . import pixels as pixels
from . import reading as reading
from . import views as views
