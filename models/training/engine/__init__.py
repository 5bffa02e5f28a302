"""Training of any model: the `loop`, its run directory, the device, and the cache of frozen features.

It knows no method. May import models.language.
"""
