"""What trains any model: the `loop`, its run directory, several processes, and the cache of frozen features.

It knows no method. May import models.language and models.paper for the features and levels that processes share.
"""
