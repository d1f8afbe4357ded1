"""Coloring art: a drawing, rules about its regions, and colours that satisfy them (dissertation 4.5, appendix B.1).

drawing    the drawing: regions, their areas, which are neighbours
svg        the regions of an SVG file, and the file with new colours
raster     an SVG as pixels
styles     the paint of a shape of an SVG
rule       one rule
rules      rules about the regions; a small TOML file
agree      whether rules can hold together, and which ones cannot
model      the compatibility model
search     colourings that differ
kept       how well each rule is kept
settle     a colouring moved uphill until its rules are kept
lab        CIELAB as the model sees it
files      SVG, PNG, a sheet, the residuals
drawings/  four drawings of our own, with rules
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
