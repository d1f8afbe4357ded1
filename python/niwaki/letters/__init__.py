"""Words written in vines or lightning: every letter is grown into its glyph by the guide that comes with the model.

glyphs   characters of a font as drawings in pieces, and where they are on the page
places   from where, and in which directions, a piece of a glyph can be grown
word     a text, grown: as picture, SVG and animation
"""

from niwaki.letters.word import Word, write

__all__ = ["Word", "write"]
