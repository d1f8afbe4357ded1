"""A result as pictures and files.

picture.py  a scene, and its target as a ghost, as one picture
sheet.py    several pictures on one page, with captions
plan.py     a scene from above, as SVG or pixels
swatches.py palettes of colours in rows
files.py    a scene as GLB, OBJ, STL or PLY
palette.py  colours for parts that have none of their own
"""
