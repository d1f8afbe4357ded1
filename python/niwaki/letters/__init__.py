"""Texts written in vines or lightning, each letter grown into its glyph with the guide that comes with the model.

- glyphs: characters of a font as drawings in pieces, and their places on the page
- places: starts and directions from which a piece of a glyph can be grown
- word: a grown text, as picture, SVG and animation
"""

from niwaki.letters.word import Word, write

__all__ = ["Word", "write"]
