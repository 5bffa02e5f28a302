import re


def test_docs_page_loads_nothing_from_another_origin(api):
    page = api.get("/docs").text
    assets = re.findall(r"""(?:src|href)=["']([^"']+)""", page)
    assert len(assets) >= 3
    for asset in assets:
        assert re.match(r"/[^/]", asset)
        assert api.get(asset).status_code == 200
    assert not re.search(r"https?://", page)
    assert '"validatorUrl": null' in page
    style = next(asset for asset in assets if asset.endswith(".css"))
    assert not re.search(r"(@import|url\(\s*['\"]?(https?:)?//)", api.get(style).text)


def test_there_is_no_second_page_of_docs(api):
    assert api.get("/redoc").status_code == 404


def test_openapi_describes_bodies_answers_and_problems(api, text):
    document = api.get("/openapi.json").json()
    post = document["paths"]["/localize"]["post"]
    assert {int(status) for status in post["responses"]} == {200, 400, 404, 406, 408, 413, 415, 422, 429, 500, 503, 504}
    for path in document["paths"].values():
        for operation in path.values():
            for status, response in operation["responses"].items():
                if int(status) >= 400:
                    assert set(response["content"]) == {"application/problem+json"}
                    [content] = response["content"].values()
                    assert content["schema"] == {"$ref": "#/components/schemas/ProblemBody"}
                    assert all(e["value"]["status"] == int(status) for e in content.get("examples", {}).values())
    assert set(post["responses"]["200"]["content"]) == {
        "application/json",
        "application/geo+json",
        "application/pidf+xml",
    }
    schemas = document["components"]["schemas"]
    assert schemas["LocalizeRequest"]["examples"][0]["description"] == text
    assert schemas["LocalizeRequest"]["additionalProperties"] is False
    assert "HTTPValidationError" not in schemas
    assert "| `queue_full` | 429 |" in document["info"]["description"]


def test_examples_are_true(api):
    schemas = api.get("/openapi.json").json()["components"]["schemas"]
    answer = api.post("/localize", json=schemas["LocalizeRequest"]["examples"][0]).json()
    example = schemas["LocalizeResponse"]["examples"][0]
    assert set(example) == set(answer)
    assert set(example["estimate"]) == set(answer["estimate"])
    assert set(example["candidates"][0]) == set(answer["candidates"][0])
    assert set(example["timings_ms"]) == set(answer["timings_ms"])
