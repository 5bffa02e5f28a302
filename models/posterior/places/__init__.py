"""Where a text that names places was said: kernels of distance and bearing, and the field that they make of a map.

`kernels` has what is fitted, `field` puts a text's mentions on a map. May import models.citymap's gazetteer and
models.language.mentions.
"""
