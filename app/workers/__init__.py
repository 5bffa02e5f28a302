"""The processes that hold a model: `process` is theirs, `launch` and `pool` start them, `remote` is for the service.

`sums` reads the files of what they have opened again, in one more.

One process opens an index; workers are forked from it, so that they share its memory, and one that dies is forked anew.
The service itself holds no model and imports no torch. May import index.
"""
