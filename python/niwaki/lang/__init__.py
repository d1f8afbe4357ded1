"""From a Python function to core form, and the plain-Python run.

scope          the scope of each name; what nested functions capture
names          what names mean outside of the model
constants      which Python objects may cross as data
sites          the readable names of choices, calls and loops
vocabulary     built-ins, `math` and our words, as operations
core           the core form: grammar and writer
marks          functions that are marked for the language
program, body  the state of one lowering, and of one function in it
expressions, statements, comprehensions, arguments, callees, builtin_calls, inference, looking, calls,
refuse, lower  the lowering: one function for each kind of syntax
instrument, densities, plain
               a model as ordinary Python
compiled       a model with its program for the engine; tasks
models         `@model`
constraints, residuals
               the soft constraints of a run, and how far they are from holding
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
