"""The HTTP service: request and response schemas, formats, routes, the queue before the workers, and errors.

All routes share `keys`, `bodies`, `middleware` and `openapi`. `indexes` holds the served indexes, `protocol` is the
interface of a localizer, and `dependencies` passes both to the routes.
"""
