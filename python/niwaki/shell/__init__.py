"""The shell's commands, one a file; `app` lists them and loads each when it is used.

| file | contents |
| --- | --- |
| `app.py` | the application, and the options that commands share |
| `arguments.py` | the arguments of a model, as NAME=VALUE and presets |
| `batch.py`, `batch_files.py` | `niwaki batch`: many searches; the TOML file that describes them |
| `check.py` | `niwaki check`: functions and choices of a model, with advice |
| `clock.py` | the time of a command, by its parts |
| `color.py` | `niwaki color`: a drawing in several colourings |
| `compare.py` | `niwaki check --try`: searches of two versions of a model |
| `controls.py` | flags for the target of a shape and its constraints |
| `demo.py` | the gallery, grown into its targets |
| `doctor.py` | `niwaki doctor`: a report on the installation |
| `explain.py` | `niwaki explain`: the work of each strategy for one proposal, as a picture |
| `folders.py` | the output folder or file of a command |
| `formats.py` | the formats in which a result is written |
| `grow.py` | `niwaki grow`: a search, written to a folder |
| `guide.py` | `niwaki guide`: training of a guide, and a report about one |
| `init.py` | `niwaki init`: a folder to begin with |
| `letters.py` | `niwaki letters`: a text in vines or lightning |
| `main.py` | the program: streams, errors, exit codes |
| `mcp.py` | `niwaki mcp`: the studio's messages as tools for programs |
| `models.py` | `niwaki models`: the gallery |
| `origin.py` | `--from`, `--hold`, `--reroll`: a new search from an earlier result |
| `pictures.py` | the pictures of a result |
| `progress.py` | progress of a search, in lines |
| `references.py` | a model by its name or its file |
| `replay.py` | `niwaki replay`: a stored result again, in any format |
| `replay_changed.py` | `niwaki replay --anyway`: a stored result, with a model that has changed |
| `reports.py` | reports on a model and its runs, as values |
| `request.py` | the search that the flags of `grow` describe |
| `requirements.py` | requirements beside a model, which results have to keep |
| `results.py` | a folder of results: run.json and the files beside it |
| `resume.py` | `--resume`: a search that was stopped or killed |
| `run_files.py` | run.json: a search and its runs as a file |
| `sample.py` | `niwaki sample`: Markov chains, written to a folder |
| `selection.py` | results of a search by their numbers |
| `settings.py` | flags for the settings of methods |
| `show.py` | `niwaki show`: runs of a model, as a sheet |
| `studio.py` | `niwaki studio`: a page in the browser |
| `trust.py` | permission to run the Python file of a stored model |
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
