"""The shell's commands, one a file; `niwaki.cli` puts them together.

app.py       the application they hang on, and what they share: arguments, folders, the line that shows progress
grow.py      `niwaki grow`: a search, written to a folder
replay.py    `niwaki replay`: the best of a search once more
models.py    `niwaki models`: the gallery
check.py     `niwaki check`: what a model is made of
"""
