"""The process that does the work of a session: it alone imports models, runs them and reads what users sent.

- `loop`     jobs in, reports out; the flag that stops a search
- `loading`  files of models that are run
- `models`   models by reference
- `offers`   what can be chosen
- `asks`     what is asked, as a target and a score
- `kinds`    which module does a job: scenes, structures, drawings
- `jobs`     scenes: searches, parts grown again, choices changed
- `values`   searches that another program asks for by values, and stored ones that are carried out again
- `drag`     a part that is dragged
- `runs`     stored runs: replayed, described, shown, written
- `differences`  where a result differs from what is wanted
- `variety`  how different results look, and which of many to show
- `allowed`  which files may be run for a stored run
- `places`   where in the source a choice is made and a part is emitted, and how a choice's slider goes
- `shapes`   a scene as a mesh for the page
- `structures`  blocks that stand: found, judged, cut
- `coloring`  drawings that are coloured: regions, rules, colourings
- `thinning`  a large mesh with fewer triangles, for the eye
- `uploads`  a mesh that a user sent, read within limits
"""
