"""What is served of language besides weights: names of classes and colours, related classes, sizes.

The TOML files hold it, `lexicon` loads it. It is part of the hint posterior's fingerprint. What only trains lies in
`models.language.grammar`. May import models.citymap.
"""
