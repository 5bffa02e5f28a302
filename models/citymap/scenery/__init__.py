"""The map as the page draws it: `shapes` of geometry or a `cloud` of points, and their `files`.

May import what models.citymap may.
"""
