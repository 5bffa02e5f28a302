"""The offline job: map -> cells -> vectors -> an index version.

`build` is all of it, in one process or of a `shard`; `part` is what is heavy to make of some cells, kept in `parts`
until all are there; `publish` makes the rest and the version; `on_ray` has a cluster make the shards. May import index,
its posterior and stores, and what models serves.
"""
