"""A scene of flat shapes as a drawing.

strokes   strokes that continue one another, as smooth curves that taper
marks     filled outlines in order, each named by the address of its part; the styles
drawing   marks as pixels
svg       marks as SVG, each part a group with a readable id
"""
