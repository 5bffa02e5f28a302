"""A request to each operation that succeeds, and how to send it with something changed."""

JSON = {"Content-Type": "application/json"}
GOOD = {  # by method and path of the OpenAPI document: what httpx sends
    "POST /localize": {"json": {"description": "a tree"}},
    "POST /localize/batch": {"json": {"items": [{"description": "a tree"}]}},
    "POST /describe": {"json": {"position": [0, 0]}},
    "POST /corrections": {"json": {"request": {"description": "a tree"}, "position": [0, 0]}},
    "POST /evaluate": {"json": {"queries": [{"description": "a tree", "position": [0, 0]}]}},
    "GET /evaluate/{job}": {},
    "DELETE /evaluate/{job}": {},
    "GET /evaluate/{job}/events": {},
    "GET /search": {"params": {"q": "a tree"}},
    "GET /reverse": {"params": {"lat": 60.17, "lon": 24.94}},
    "GET /lookup": {"params": {"osm_ids": "N1"}},
    "GET /status": {},
    "GET /cells": {},
    "GET /cells/{cell_id}": {},
    "GET /maps/{name}": {},
    "GET /maps/{name}/points": {},
    "GET /indexes": {},
    "GET /healthz": {},
    "GET /readyz": {},
    "GET /metrics": {},
    "GET /info": {},
}
IN_PATH = {"job": "none", "cell_id": "fakeville_00001", "name": "fakeville"}
WITH_BODY = tuple(operation for operation, sent in GOOD.items() if "json" in sent)


def ask(client, operation, in_path=None, **changed):
    """The answer to a good request, but for what is changed: in its path, or of what httpx sends."""
    method, _, path = operation.partition(" ")
    return client.request(method, path.format(**(IN_PATH | (in_path or {}))), **(GOOD[operation] | changed))
