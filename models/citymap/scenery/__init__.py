"""What a map looks like, for whoever draws it: `shapes` of geometry, `cloud` of points, a blob each, and their `files`.

May import what models.citymap may.
"""
