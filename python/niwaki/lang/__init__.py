"""The modelling language: the compiler from Python functions to core form, and the plain-Python run.

- `scope`: the scopes of names, and the captures of nested functions
- `names`: names from outside of a model
- `constants`: Python objects that may cross to the engine as data
- `sites`: readable names of choices, calls and loops
- `vocabulary`: built-ins, `math` and the words of the package, as operations
- `core`: the core form, its grammar and its writer
- `marks`: functions that are marked for the language
- `program`, `body`: the state while a program, and a function of it, are lowered
- `expressions`, `statements`, `comprehensions`, `arguments`, `callees`, `builtin_calls`, `emits`, `inference`,
  `looking`, `calls`, `refuse`, `lower`: the lowering, with a function for each kind of syntax
- `instrument`, `densities`, `futures`, `memoised`, `inner`, `plain`: a model as ordinary Python
- `compiled`: a model with its program for the engine; tasks
- `models`: `@model`
- `advice`: advice of `niwaki check`
- `blame`: parts of scenes that broke a constraint
- `constraints`, `residuals`: the soft constraints of a run, and their distances from holding
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
