"""Drawings of flat shapes.

strokes   connected strokes as smooth curves that taper
marks     filled outlines in order, with the address of the part; the styles
drawing   marks as pixels
svg       marks as SVG: a group with a readable id for each part
"""
