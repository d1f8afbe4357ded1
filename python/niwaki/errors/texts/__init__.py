"""The texts of all messages, by the part that reports the error.

message    the shape of an entry
language   the compiler: a model breaks a rule
faults     the engine and the plain run: a model failed while it ran
inputs     settings and arguments
views      images to match, cameras, lights, receivers and obstacles; part of inputs
guides     guides, their files and their training; part of inputs
files      files, and the settings of targets and pictures
drawings   drawings to color, and rules about their regions; part of files
batches    batches: their folders and their workers; part of settings
settings   settings, models and run files, given in Python or in a shell
advice     `niwaki check`: a model is right and could be more efficient
"""
