import json
import shutil

import pytest

from index.artifact import (
    check_model,
    open_version,
    read_aliases,
    set_alias,
)
from index.localizer import Localizer
from models.errors import IndexBroken, IndexMismatch
from models.files import new_directory
from models.retrieval.checkpoint import save_retriever
from models.retrieval.mncl import Mncl


@pytest.fixture
def copy(index_dir, tmp_path):
    shutil.copytree(index_dir, tmp_path / "index")
    return tmp_path / "index"


def test_the_manifest_says_what_is_there(index_dir, city, cells, model) -> None:
    directory, manifest = open_version(index_dir)
    assert directory.name == manifest.version
    assert manifest.cells == len(cells)
    assert manifest.instances == len(city.instances)
    assert manifest.model_fingerprint == model.fingerprint
    assert set(manifest.files) == {
        *("vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json", "surroundings.safetensors"),
        *("gazetteer.safetensors", "gazetteer.json", "meanings.faiss", "meanings.json", "scenery.0.safetensors.gz"),
    }
    assert not list(index_dir.glob(".*"))


def test_a_version_opens_by_its_own_path(index_dir) -> None:
    directory, manifest = open_version(index_dir)
    assert open_version(directory) == (directory, manifest)


def test_no_index_is_a_clear_error(tmp_path) -> None:
    with pytest.raises(IndexBroken, match=r"no index in .* build it with"):
        open_version(tmp_path / "nowhere")


def version_file(root, name):
    return root / read_aliases(root)["default"] / name


@pytest.mark.parametrize("name", ["vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json"])
def test_cut_changed_and_missing_files_are_noticed(copy, name) -> None:
    path = version_file(copy, name)
    whole = path.read_bytes()
    path.write_bytes(whole[:-1])
    with pytest.raises(IndexBroken, match="cut short"):
        open_version(copy)
    path.write_bytes(bytes([whole[0] ^ 1]) + whole[1:])
    with pytest.raises(IndexBroken, match="changed"):
        open_version(copy)
    path.unlink()
    with pytest.raises(IndexBroken, match="missing"):
        open_version(copy)


@pytest.mark.parametrize("text", ["", "{", "[]", '{"format": 1}'])
def test_a_broken_manifest_is_noticed(copy, text) -> None:
    version_file(copy, "manifest.json").write_text(text)
    with pytest.raises(IndexBroken, match="broken or of another version"):
        open_version(copy)


def test_another_format_is_refused(copy) -> None:
    path = version_file(copy, "manifest.json")
    path.write_text(json.dumps(json.loads(path.read_text()) | {"format": 99}))
    with pytest.raises(IndexBroken, match="format 99"):
        open_version(copy)


@pytest.mark.parametrize("text", ["{", "3"])
def test_broken_aliases_are_noticed(copy, text) -> None:
    (copy / "aliases.json").write_text(text)
    with pytest.raises(IndexBroken, match="cannot be read"):
        open_version(copy)


def test_a_manifest_cannot_name_files_elsewhere(copy) -> None:
    path = version_file(copy, "manifest.json")
    manifest = json.loads(path.read_text())
    manifest["files"]["../../../etc/passwd"] = manifest["files"].pop("cells.json")
    path.write_text(json.dumps(manifest))
    with pytest.raises(IndexBroken, match=r"passwd is missing"):
        open_version(copy)


def test_a_failed_build_leaves_nothing(tmp_path) -> None:
    with pytest.raises(IsADirectoryError), new_directory(tmp_path / "v1") as directory:
        directory.write_text("x")
    assert list(tmp_path.iterdir()) == []


def test_aliases_switch(tmp_path) -> None:
    for version in ("v1", "v2"):
        with new_directory(tmp_path / version) as directory:
            (directory / "x").write_text(version)
        set_alias(tmp_path, "default", version)
    set_alias(tmp_path, "canary", "v1")
    assert read_aliases(tmp_path) == {"default": "v2", "canary": "v1"}
    assert (tmp_path / "v1" / "x").read_text() == "v1", "older versions stay"


def test_an_index_of_another_model_is_refused(index_dir, model, text_encoder, tmp_path) -> None:
    twin = Mncl(text_encoder, model.config)  # the same shape, other weights
    save_retriever(twin, tmp_path, {})
    with pytest.raises(IndexMismatch, match="was built by model"):
        Localizer.open(index_dir, tmp_path)
    check_model(open_version(index_dir)[1], model.fingerprint)
