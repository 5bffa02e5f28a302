"""Worker processes that hold the model: `process` runs in them, `launch` and `pool` start them, `remote` calls them.

One process opens an index. Workers are forked from it, so that they share its memory; a worker that dies is replaced.
The service itself holds no model and imports no torch. `checksums` verifies an index in another process.
"""
