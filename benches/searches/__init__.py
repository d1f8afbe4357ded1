"""The bench of searches, a file for each of its parts.

seeds      which targets and which searches there are, for development and for judgement
models     models that stand beside the gallery's
targets    solids that are made from seeds, in named parts
drawings   images that are made from seeds
measures   how much of each part a scene has
problems   the table of problems: model, target, parts
complete   the least share of each part that makes a result complete, and why
methods    the table of methods
searching  one search, its CPU seconds, and how large a method must be to cost as much as another
records    one line for each search, and which version of the code it was
table      the tables of the manual, and paired differences of two methods or versions
sheets     the median and the worst result of each problem beside its target, as a picture
"""
