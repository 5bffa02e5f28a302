"""The routes of the service, one module per resource. They may import whatever app.http may."""
