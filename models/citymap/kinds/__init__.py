"""Kinds of OpenStreetMap objects, what people call them, and the brands of chains.

`vocabulary` is what others use. `matching` says which kinds an object's tags make it, `words` which nouns people use
for them, `brands` knows chains by their spellings. `make` writes the vendored files (`kinds.json.xz`,
`names.json.xz`, `brands.json.xz`, `LICENCES.md`) from the published packages, as `selection.toml` says; `ours.toml` and
`people.toml` are written by hand: kinds that the packages lack, and everyday words.

May import models.errors and models.files.
"""
