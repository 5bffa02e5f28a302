"""The service's routes, one file a resource: localize, evaluate, cells, health. May import what app.http may."""
