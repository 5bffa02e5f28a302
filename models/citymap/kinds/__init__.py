"""Kinds of OpenStreetMap objects, their everyday names, and the brands of chains.

`vocabulary` is the interface. `matching` finds the kinds of an object by its tags, `words` has the nouns for kinds,
`brands` finds chains by the spellings of their names. `make` writes the vendored files (`kinds.json.xz`,
`names.json.xz`, `brands.json.xz`, `LICENCES.md`) from the published packages, as `selection.toml` says; `ours.toml`
and `people.toml` are written by hand: kinds that the packages lack, and everyday words.

May import models.errors and models.files.
"""
