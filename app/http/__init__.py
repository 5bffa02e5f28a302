"""The HTTP service: schemas/ of requests and responses, formats/, routes/, the queue before the model, errors.

`keys`, `bodies`, `connection`, `middleware` and `openapi` are what all routes share, `indexes` what is served,
`protocol` what a route asks of a localizer, `dependencies` hand it over. May import app.jobs, app.settings, and of
index and models the types of answers, the errors and what splits a text.
"""
