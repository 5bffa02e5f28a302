"""The OpenAPI document: the errors, formats and keys that FastAPI does not document by itself."""

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from app.http.errors import PROBLEM_JSON, Code, Problem, ProblemBody
from app.http.formats import geojson, pidf
from app.http.formats.negotiation import GEOJSON, JSON, PIDF
from app.http.keys import OPEN, SCHEMES

PROBLEM_SCHEMA = {"$ref": f"#/components/schemas/{ProblemBody.__name__}"}
Responses = dict[int | str, dict[str, Any]]


def problems(*codes: Code) -> Responses:
    """Return the `responses=` of a route that can fail with these codes."""
    by_status: dict[int, list[Code]] = {}
    for code in sorted(codes, key=lambda code: code.status):
        by_status.setdefault(code.status, []).append(code)
    return {
        status: {
            "model": ProblemBody,
            "description": "; ".join(code.title for code in errors),
            "content": {PROBLEM_JSON: {"examples": {code.code: {"value": Problem(code).body()} for code in errors}}},
        }
        for status, errors in by_status.items()
    }


def geojson_content() -> dict[str, Any]:
    """Return the `responses={200: ...}` of a route that also answers in GeoJSON."""
    schema = {"type": "object", "required": ["type", "features"], "description": "RFC 7946 FeatureCollection"}
    return {"content": {GEOJSON: {"schema": schema, "example": geojson.EXAMPLE}}}


def localize_content() -> dict[str, Any]:
    """Return the `responses={200: ...}` of POST /localize: GeoJSON, and PIDF-LO."""
    schema = {"type": "string", "description": "PIDF-LO (RFC 4119, RFC 5491, RFC 7459)"}
    return {"content": {**geojson_content()["content"], PIDF: {"schema": schema, "example": pidf.EXAMPLE}}}


def describe(app: FastAPI, needs_key: bool) -> dict[str, Any]:
    """Return the OpenAPI document of an application, with errors as problem+json; it is built once."""
    if app.openapi_schema is None:
        document = get_openapi(
            title=app.title, version=app.version, description=app.description, routes=app.routes, tags=app.openapi_tags
        )
        for path in document["paths"].values():
            for operation in path.values():
                responses = operation["responses"]
                if PROBLEM_JSON not in responses.get("422", {}).get("content", {}):
                    responses.pop("422", None)  # FastAPI adds one for any parameter, even one that accepts everything
                for status, response in responses.items():
                    if int(status) >= 400:  # problem+json instead of FastAPI's application/json and its own 422 model
                        del response["content"][JSON]
                        response["content"].setdefault(PROBLEM_JSON, {})["schema"] = PROBLEM_SCHEMA
        for unused in ("HTTPValidationError", "ValidationError"):
            document["components"]["schemas"].pop(unused, None)
        if needs_key:
            _require_key(document)
        app.openapi_schema = document
    return app.openapi_schema


def error_table() -> str:
    """Return the table of codes in Markdown."""
    rows = [f"| `{code.code}` | {code.status} | {code.title}. {code.remedy} |" for code in Code]
    return "\n".join(["| code | status | meaning and remedy |", "|---|---|---|", *rows])


def _require_key(document: dict[str, Any]) -> None:
    """Make /docs show a button for the key, and add the 401 to every operation that is not open."""
    document["components"]["securitySchemes"] = SCHEMES
    document["security"] = [{name: []} for name in SCHEMES]  # open routes override it
    [(status, refused)] = problems(Code.KEY_REQUIRED, Code.KEY_WRONG).items()
    content = {PROBLEM_JSON: {**refused["content"][PROBLEM_JSON], "schema": PROBLEM_SCHEMA}}
    for path in document["paths"].values():
        for operation in path.values():
            if operation.get("security") != OPEN["security"]:
                operation["responses"][str(status)] = {"description": refused["description"], "content": content}
