"""What a map looks like, for whoever draws it: `shapes` of geometry, `cloud` of points. A blob each, ready to be sent.

May import what models.city may.
"""
