"""The worker process of a session: only this process imports models, runs them and reads uploads.

- `loop`         jobs in, reports out; the flag that stops a search
- `loading`      loading files of models
- `models`       models by reference
- `offers`       the lists of models and targets
- `asks`         goals as targets and scores
- `kinds`        the module of a job: scenes, structures or drawings
- `jobs`         scenes: searches, parts grown again, changed choices
- `values`       searches of other programs by values, and repeated searches
- `drag`         dragged parts
- `reports`      reports on models: checked, run without a target, explained, fitted
- `primitives`   primitive targets: a box, a ball, a column
- `pictures`     small pictures for clients that show no meshes
- `runs`         stored runs: replayed, described, shown, written
- `differences`  differences between a result and its target
- `variety`      different looks of results, and the choice of results to show
- `permissions`  files that may be run for a stored run
- `confinement`  the folders below which a worker may write, on Linux
- `places`       places of choices and parts in the source, and ranges of sliders
- `shapes`       a scene as a mesh for the page
- `structures`   structures of blocks: searched, checked, cut
- `coloring`     drawings to colour: regions, rules, colourings
- `thinning`     a large mesh with fewer triangles, for display
- `uploads`      an uploaded mesh or drawing, read within limits
"""
