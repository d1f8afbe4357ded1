"""The shell's commands, one a file; `app` lists them and loads each when it is used.

app.py        the application, and what the commands share: arguments, folders
progress.py   how a search goes on, in lines
trying.py     two versions of a model, searched side by side
arguments.py  the arguments of a model, as NAME=VALUE and presets
controls.py   what the shape should be like, as flags
settings.py   how to search, as flags
writing.py    which files a result becomes
pictures.py   which pictures, and drafts
picking.py    results by their numbers
held.py       parts of a result that are held, or grown again
clock.py      where the time of a command went
show.py       `niwaki show`: runs of a model, as a sheet
grow.py       `niwaki grow`: a search, written to a folder
resuming.py   `--resume`: a search goes on that was stopped or killed
replay.py     `niwaki replay`: a result once more, in any format
sample.py     `niwaki sample`: Markov chains, written to a folder
explain.py    `niwaki explain`: what each strategy does for one proposal, as a picture
guide.py      `niwaki guide`: trains a guide, shows what one sees
letters.py    `niwaki letters`: a text in vines or lightning
models.py     `niwaki models`: the gallery
color.py      `niwaki color`: a drawing in colours that differ
studio.py     `niwaki studio`: a page, served to this machine
references.py a model by its name or its file
run_files.py  a search and its runs as a file
results.py    a folder of one run: that file, and those that show the run
folders.py    a folder of its own for the results of a command
anyway.py     a run of a model that has changed since
trust.py      when a replay runs the Python file of its model
demo.py       the gallery, grown into its targets
check.py      `niwaki check`: what a model is made of, with advice
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
