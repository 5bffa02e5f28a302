"""Kinds of OpenStreetMap objects, their everyday names, and the brands of chains.

`vocabulary` is the interface. `matching` finds the kinds of an object by its tags, `words` has the nouns for kinds,
`brands` finds chains by the spellings of their names. `make` writes the vendored files (`*.json.xz`, `LICENCES.md`)
from the published packages, as `selection.toml` says. `ours.toml` (kinds that the packages lack) and `people.toml`
(everyday words) are written by hand. May import models.errors and models.files.
"""
