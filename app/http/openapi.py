"""What /docs and /openapi.json say about errors and formats that FastAPI cannot know."""

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from app.http.errors import PROBLEM_JSON, Code, Problem, ProblemBody
from app.http.formats import geojson
from app.http.formats.negotiation import GEOJSON, JSON
from app.http.keys import OPEN, SCHEMES

PROBLEM_SCHEMA = {"$ref": f"#/components/schemas/{ProblemBody.__name__}"}
Responses = dict[int | str, dict[str, Any]]


def problems(*codes: Code) -> Responses:
    """`responses=` of a route that can fail in these ways."""
    by_status: dict[int, list[Code]] = {}
    for code in codes:
        by_status.setdefault(code.status, []).append(code)
    return {
        status: {
            "model": ProblemBody,
            "description": "; ".join(code.title for code in alike),
            "content": {PROBLEM_JSON: {"examples": {code.code: {"value": _example(code)} for code in alike}}},
        }
        for status, alike in by_status.items()
    }


def geojson_content() -> dict[str, Any]:
    """`responses={200: ...}` of a route that also answers in GeoJSON."""
    schema = {"type": "object", "required": ["type", "features"], "description": "RFC 7946 FeatureCollection"}
    return {"content": {GEOJSON: {"schema": schema, "example": geojson.EXAMPLE}}}


def describe(app: FastAPI, needs_key: bool) -> dict[str, Any]:
    """The OpenAPI document, with errors as problem+json; made once.

    Args:
        app: what is described.
        needs_key: whether all that is not open needs a key.
    """
    if app.openapi_schema is None:
        document = get_openapi(
            title=app.title, version=app.version, description=app.description, routes=app.routes, tags=app.openapi_tags
        )
        for path in document["paths"].values():
            for operation in path.values():
                for status, response in operation["responses"].items():
                    if int(status) >= 400:
                        _as_problem(response["content"])
        for unused in ("HTTPValidationError", "ValidationError"):
            document["components"]["schemas"].pop(unused, None)
        if needs_key:
            _ask_for_key(document)
        app.openapi_schema = document
    return app.openapi_schema


def error_table() -> str:
    """The table of codes, in Markdown."""
    rows = [f"| `{code.code}` | {code.status} | {code.title}. {code.remedy} |" for code in Code]
    return "\n".join(["| code | status | what and what to do |", "|---|---|---|", *rows])


def _ask_for_key(document: dict[str, Any]) -> None:
    """With a global requirement, /docs has a button for the key; open routes lift it for themselves."""
    document["components"]["securitySchemes"] = SCHEMES
    document["security"] = [{name: []} for name in SCHEMES]
    [(status, refused)] = problems(Code.KEY_REQUIRED, Code.KEY_WRONG).items()
    content = {PROBLEM_JSON: {**refused["content"][PROBLEM_JSON], "schema": PROBLEM_SCHEMA}}
    for path in document["paths"].values():
        for operation in path.values():
            if operation.get("security") != OPEN["security"]:
                operation["responses"][str(status)] = {"description": refused["description"], "content": content}


def _as_problem(content: dict[str, Any]) -> None:
    """FastAPI says application/json, and its own model for a 422; ours is a problem and goes out as problem+json."""
    del content[JSON]
    content.setdefault(PROBLEM_JSON, {})["schema"] = PROBLEM_SCHEMA


def _example(code: Code) -> dict[str, Any]:
    return Problem(code).body()
