"""The manifests of docker/kubernetes as they reach a cluster, put together as kustomize does it."""

from pathlib import Path
from typing import Any

import jsonpatch
import yaml

ROOT = Path(__file__).parent.parent / "docker/kubernetes"
LAYERS = ("base", "milvus")
Document = dict[str, Any]


def kustomization(layer: str) -> Document:
    """Return the kustomization of a layer."""
    loaded: Document = yaml.safe_load((ROOT / layer / "kustomization.yaml").read_text())
    return loaded


def built(layer: str) -> list[Document]:
    """All documents of a layer: its resources, patched by JSON patches, with the images it names."""
    layer_file = kustomization(layer)
    documents: list[Document] = []
    for name in layer_file["resources"]:
        path = (ROOT / layer / name).resolve()
        documents += built(path.name) if path.is_dir() else yaml.safe_load_all(path.read_text())
    for patch in layer_file.get("patches", ()):
        documents = _patched(documents, yaml.safe_load((ROOT / layer / patch["path"]).read_text()), patch["target"])
    for image in layer_file.get("images", ()):
        for container in containers(documents):
            if container["image"] == image["name"]:
                container["image"] += f":{image['newTag']}"
    return documents


def _patched(documents: list[Document], patch: list[Document], target: Document) -> list[Document]:
    """The documents, those that a patch is for changed by it."""
    wanted = [
        document["kind"] == target["kind"] and target.get("name", document["metadata"]["name"]) == name(document)
        for document in documents
    ]
    assert any(wanted), f"nothing is {target}"
    applied: list[Document] = [
        jsonpatch.apply_patch(document, patch) if is_for else document
        for document, is_for in zip(documents, wanted, strict=True)
    ]
    return applied


def name(document: Document) -> str:
    """Return its name."""
    called: str = document["metadata"]["name"]
    return called


def template(document: Document) -> Document | None:
    """The pods that it makes; None if it makes none."""
    if document["kind"] == "Pod":
        return document
    spec = document.get("spec", {})
    made: Document | None = spec.get("jobTemplate", {}).get("spec", spec).get("template")
    return made


def pods_of(document: Document) -> Document:
    """The pods that it makes, which it does."""
    made = template(document)
    assert made is not None
    return made


def containers(documents: list[Document]) -> list[Document]:
    """All containers of their pods."""
    templates = [made for made in map(template, documents) if made]
    return [container for made in templates for container in made["spec"]["containers"]]


def one(documents: list[Document], kind: str, called: str = "hereabouts") -> Document:
    """The one of a kind and name."""
    [only] = [document for document in documents if (document["kind"], name(document)) == (kind, called)]
    return only
