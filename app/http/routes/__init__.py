"""The service's routes, one file a resource: localize, describe, evaluate, cells, maps, health, page.

May import what app.http may.
"""
