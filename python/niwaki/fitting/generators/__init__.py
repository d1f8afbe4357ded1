"""Generators: models of which only parameters and a mesh are known, and how a worker process loads them.

| module | contents |
| --- | --- |
| `generator` | the interface |
| `functions` | Python functions: ranges from their signature, or draws while they run |
| `draws` | draws while a function runs: `d.real`, `d.whole`, `d.switch`, `d.choice` |
| `commands` | programs that write a mesh file: `nw.command` |
| `customizer` | parameters of an OpenSCAD file, from the comments of its Customizer |
| `scad` | OpenSCAD files: `nw.scad` |
| `loading` | the generator of whatever a person gives to `nw.fit`, and of the data that a worker process gets |
"""
