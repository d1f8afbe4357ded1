"""Coloring art: a drawing, rules about its regions, and colours that satisfy them (dissertation 4.5, appendix B.1).

Modules:

    drawing      the regions of a drawing: areas and neighbours
    svg          the regions of an SVG file, and the file with new colours
    raster       an SVG as pixels
    styles       the paint of a shape of an SVG
    rule         one rule
    rules        the rules of a drawing; a small TOML file
    consistency  contradictions between rules
    model        the compatibility model
    search       colourings that differ
    report       how well a colouring keeps each rule
    settle       a colouring moved uphill until its rules hold
    lab          CIELAB as the model computes it
    files        SVG, PNG, a sheet, the residuals
    drawings/    the four drawings of the package, with rules
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
