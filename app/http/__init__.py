"""The HTTP service: requests and responses, routes/, the queue before the model, errors as problem+json.

`negotiation` and `geojson` give other forms of an answer, `keys`, `middleware` and `openapi` what all routes share,
`protocol` is what a route asks of a localizer, `dependencies` hand it over. May import app.jobs, app.settings, and of
index and models the types of answers, the errors and what splits a text.
"""
