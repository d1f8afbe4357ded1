"""How Sphinx builds the manual; `make docs` treats its warnings as errors.

Before it, `docs/running/snippets.py` runs the snippets of the pages and `docs/running/reference.py` writes pages from
the package, both into `docs/made`.
"""

from importlib.metadata import version as installed_version

project = "Niwaki"
author = "The Niwaki authors"
copyright = "2026, The Niwaki authors"
version = release = installed_version("niwaki")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["_build", "made/guide", "made/tutorials", "made/ideas"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
# Plain words in angle brackets and error codes are no links: what is not found must fail the build.
nitpicky = True
# Types in signatures are named by the module that defines them; their pages have the public names.
nitpick_ignore_regex = [("py:.*", ".*")]
# The catalogue's pages are written from the table of messages; before the first one there is nothing to list.
suppress_warnings = ["toc.empty_glob"]

autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "inherited-members": False, "show-inheritance": False}
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_ivar = True

html_theme = "furo"
html_title = "Niwaki"
html_copy_source = False
