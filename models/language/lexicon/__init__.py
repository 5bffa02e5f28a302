"""The lexicon: names of classes and colours, related classes and sizes, in TOML files.

It is part of the hint posterior's fingerprint. Words for training only are in
`models.language.grammar`. May import models.citymap.
"""
