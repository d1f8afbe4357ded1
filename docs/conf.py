"""How Sphinx builds the manual; `make docs` treats its warnings as errors."""

from importlib.metadata import version as installed_version

project = "Niwaki"
author = "The Niwaki authors"
copyright = "2026, The Niwaki authors"
version = release = installed_version("niwaki")

extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
# Plain words in angle brackets and error codes are no links: what is not found must fail the build.
nitpicky = True
# The catalogue's pages are written from the table of messages; before the first one there is nothing to list.
suppress_warnings = ["toc.empty_glob"]

html_theme = "furo"
html_title = "Niwaki"
html_copy_source = False
