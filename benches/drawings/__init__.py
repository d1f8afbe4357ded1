"""How the drawings of the package were made: `make.py` writes them, from code, fonts and clip art."""
