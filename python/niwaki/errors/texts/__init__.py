"""Texts of all messages, in a file for each part that reports errors.

- message: the fields of an entry
- language: the compiler: a model breaks a rule of the language
- faults: the engine and the plain run: a model failed while it ran
- inputs: settings and arguments
- views: images to match, cameras, lights, receivers and obstacles (part of `inputs`)
- guides: guides, their files and their training (part of `inputs`)
- files: files, and the settings of targets and pictures
- drawings: drawings to color, and rules about their regions (part of `files`)
- batches: batches, their folders and their workers (part of `settings`)
- fitting: models that somebody else wrote: parameters, processes, archives (part of `settings`)
- settings: settings, models and run files, given in Python or in a shell
- shell: arguments of commands, runs by number, folders (part of `settings`)
- advice: `niwaki check`: a model is right, and a search of it could be more efficient
"""
