"""The command line: `main` has index, serve and localize; `data`, `train`, `measure` and `reproduce` the others.

`options` and `progress` are shared. May import everything below it; heavy imports stand inside the commands, so that
--help is quick.
"""
