import errno
import json
import os
import shutil
from concurrent.futures import ThreadPoolExecutor

import pytest

from index.answering.localizer import Localizer
from index.build import manifest as manifest_module
from index.build.artifact import find_version, open_version, read_aliases, register, set_alias
from index.build.manifest import FORMAT, check_model
from models.errors import IndexBroken, IndexMismatch
from models.files import new_directory
from models.paper.checkpoint import save_retriever
from models.paper.mncl import Mncl
from models.sources.osm.summary import load_gazetteer_and_summary


@pytest.fixture
def copy(index_dir, tmp_path):
    shutil.copytree(index_dir, tmp_path / "index")
    return tmp_path / "index"


def test_the_manifest_says_what_is_there(index_dir, osm_file, city, cells, model) -> None:
    directory, manifest = open_version(index_dir)
    assert directory.name == manifest.version
    assert manifest.cells == len(cells)
    assert manifest.instances == len(city.instances)
    assert manifest.model_fingerprint == model.fingerprint
    assert manifest.summary == load_gazetteer_and_summary(osm_file)[1]
    assert set(manifest.files) == {
        *("vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json"),
        *("pieces.safetensors", "statements.safetensors"),
        *(
            "gazetteer.safetensors",
            "names.safetensors",
            "landmarks.safetensors",
            "meanings.faiss",
            "meanings.json",
            "scenery.0.safetensors.gz",
        ),
    }
    assert [path.name for path in index_dir.glob(".*")] == [".lock"]


def test_a_version_opens_by_its_own_path(index_dir) -> None:
    directory, manifest = open_version(index_dir)
    assert open_version(directory) == (directory, manifest)


def test_no_index_is_a_clear_error(tmp_path) -> None:
    with pytest.raises(IndexBroken, match=r"no index in .* build it with"):
        open_version(tmp_path / "nowhere")


def version_file(root, name):
    return root / read_aliases(root).aliases["default"] / name


@pytest.mark.parametrize("name", ["vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json"])
def test_cut_changed_and_missing_files_are_noticed(copy, name) -> None:
    path = version_file(copy, name)
    whole = path.read_bytes()
    path.write_bytes(whole[:-1])
    for check in (open_version, find_version):
        with pytest.raises(IndexBroken, match="cut short"):
            check(copy)
    path.write_bytes(bytes([whole[0] ^ 1]) + whole[1:])
    with pytest.raises(IndexBroken, match="changed"):
        open_version(copy)
    find_version(copy)  # which does not read it: the service does so once it is ready
    path.unlink()
    for check in (open_version, find_version):
        with pytest.raises(IndexBroken, match="missing"):
            check(copy)


@pytest.mark.parametrize("text", ["", "{", "[]", f'{{"format": {FORMAT}}}'])
def test_a_broken_manifest_is_noticed(copy, text) -> None:
    version_file(copy, "manifest.json").write_text(text)
    with pytest.raises(IndexBroken, match=r"manifest.json (is broken|was changed)"):
        open_version(copy)


def test_a_manifest_with_any_byte_changed_is_refused_by_name(copy) -> None:
    path = version_file(copy, "manifest.json")
    whole = path.read_bytes()
    for length in range(len(whole)):
        for changed in (whole[length] ^ 1, whole[length] ^ 0x20, ord("7")):
            if changed != whole[length]:
                path.write_bytes(whole[:length] + bytes([changed]) + whole[length + 1 :])
                with pytest.raises(IndexBroken, match=r"manifest.json|has format"):
                    open_version(copy)
    path.write_bytes(whole)
    open_version(copy)


def unregistered(root):
    """The manifest of a version that was copied here from elsewhere, and its path."""
    path = version_file(root, "manifest.json")
    (root / "aliases.json").unlink()
    return path, json.loads(path.read_text())


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("dim", 0), ("dim", -1), ("cells", 0), ("metric", "l2"), ("version", "v9"), ("version", "../v"), ("files", {}),
        ("palette", "grey"), ("model_fingerprint", "0"), ("map_sha256", "z" * 64), ("grid_m", -10), ("created", "now"),
        ("store", "milvus"), ("store", "elsewhere"), ("collection", "c"),
        ("frame", {"frame_id": "map", "origin_lat": 160.0, "origin_lon": 24.9, "epsg": None}),
    ],
)  # fmt: skip
def test_each_field_of_a_manifest_is_checked(copy, field, value) -> None:
    path, manifest = unregistered(copy)
    path.write_text(json.dumps(manifest | {field: value}))
    with pytest.raises(IndexBroken, match=r"manifest.json"):
        open_version(path.parent)


def test_a_manifest_without_a_store_is_of_faiss(copy) -> None:
    path, manifest = unregistered(copy)
    path.write_text(json.dumps({key: manifest[key] for key in manifest if key not in ("store", "collection")}))
    assert open_version(path.parent)[1].store == "faiss"


def test_a_collection_has_a_name_that_milvus_takes(copy) -> None:
    path, manifest = unregistered(copy)
    path.write_text(json.dumps(manifest | {"store": "milvus", "collection": "a b"}))
    with pytest.raises(IndexBroken, match="collection"):
        open_version(path.parent)


@pytest.mark.parametrize("field", ["dim", "cells", "instances"])
def test_what_a_manifest_counts_has_to_be_there(copy, model, tmp_path, field) -> None:
    save_retriever(model, tmp_path / "weights", {})
    path, manifest = unregistered(copy)
    path.write_text(json.dumps(manifest | {field: manifest[field] + 1}))
    with pytest.raises(IndexBroken, match=field):
        Localizer.open(path.parent, tmp_path / "weights")


def test_a_version_from_elsewhere_is_registered_once_it_is_whole(copy) -> None:
    path, _ = unregistered(copy)
    version = path.parent.name
    whole = (path.parent / "cells.json").read_bytes()
    (path.parent / "cells.json").write_bytes(whole[:-1])
    with pytest.raises(IndexBroken, match="cut short"):
        register(copy, version)
    assert read_aliases(copy).versions == {}
    (path.parent / "cells.json").write_bytes(whole)
    assert register(copy, version).version == version
    assert list(read_aliases(copy).versions) == [version]
    path.write_text(path.read_text().replace("1.0", "1.1"))
    with pytest.raises(IndexBroken, match="changed"):
        register(copy, version)


@pytest.mark.parametrize("name", ["vectors.faiss", "statements.safetensors"])
def test_who_answers_once_refuses_a_file_with_a_flipped_bit(copy, weights_dir, name) -> None:
    path = version_file(copy, name)
    whole = path.read_bytes()
    path.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))  # in the data: nothing else would see it
    with pytest.raises(IndexBroken, match=f"{name} was changed"):
        Localizer.open(copy, weights_dir)
    assert Localizer.open(copy, weights_dir, with_sums=False)


def test_a_file_that_the_disk_does_not_give_is_named(copy, monkeypatch) -> None:
    def fails(_path):
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(manifest_module, "sha256", fails)
    with pytest.raises(IndexBroken, match=r"cannot be read \(Input/output error\); check its disk"):
        open_version(copy)


def test_two_writers_lose_nothing(index_dir, tmp_path) -> None:
    version, record = read_aliases(index_dir).aliases["default"], read_aliases(index_dir)
    (tmp_path / version).mkdir()
    shutil.copy(version_file(index_dir, "manifest.json"), tmp_path / version)
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda n: set_alias(tmp_path, f"a{n}", version), range(40)))
    assert len(read_aliases(tmp_path).aliases) == 40
    assert read_aliases(tmp_path).versions == record.versions


def test_another_format_is_refused(copy) -> None:
    path = version_file(copy, "manifest.json")
    path.write_text(json.dumps(json.loads(path.read_text()) | {"format": 99}))
    with pytest.raises(IndexBroken, match="format 99"):
        open_version(copy)


@pytest.mark.parametrize("text", ["{", "3"])
def test_broken_aliases_are_noticed(copy, text) -> None:
    (copy / "aliases.json").write_text(text)
    with pytest.raises(IndexBroken, match=r"aliases.json is broken"):
        open_version(copy)


def test_an_alias_that_no_file_can_have_is_refused(copy) -> None:
    known = json.loads((copy / "aliases.json").read_text())
    for alias in ("x" * 5000, "../v", "", "a\0b"):
        (copy / "aliases.json").write_text(json.dumps(known | {"aliases": {"default": alias}}))
        with pytest.raises(IndexBroken, match=r"aliases.json is broken"):
            open_version(copy)


@pytest.mark.parametrize("earlier", [6, FORMAT - 1])
def test_an_index_of_an_earlier_format_says_that_it_has_to_be_built_anew(copy, earlier) -> None:
    path, manifest = unregistered(copy)
    path.write_text(json.dumps({"format": earlier, "version": manifest["version"]}))
    (copy / "aliases.json").write_text(json.dumps({"default": manifest["version"]}))
    with pytest.raises(IndexBroken, match=rf"has format {earlier}, .* build it"):
        open_version(copy)


def test_an_unknown_alias_says_which_there_are(copy) -> None:
    with pytest.raises(IndexBroken, match=r"no index canary in .* its aliases are default"):
        open_version(copy, "canary")


def test_a_manifest_cannot_name_files_elsewhere(copy) -> None:
    path, manifest = unregistered(copy)
    manifest["files"]["../../../etc/passwd"] = manifest["files"].pop("cells.json")
    path.write_text(json.dumps(manifest))
    with pytest.raises(IndexBroken, match=r"manifest.json is broken: files"):
        open_version(path.parent)


def test_a_failed_build_leaves_nothing(tmp_path) -> None:
    with pytest.raises(IsADirectoryError), new_directory(tmp_path / "v1") as directory:
        directory.write_text("x")
    assert list(tmp_path.iterdir()) == []


def test_aliases_switch(tmp_path) -> None:
    for version in ("v1", "v2"):
        with new_directory(tmp_path / version) as directory:
            (directory / "manifest.json").write_text(version)
        set_alias(tmp_path, "default", version)
    set_alias(tmp_path, "canary", "v1")
    assert read_aliases(tmp_path).aliases == {"default": "v2", "canary": "v1"}
    assert list(read_aliases(tmp_path).versions) == ["v1", "v2"]
    assert (tmp_path / "v1" / "manifest.json").read_text() == "v1", "older versions stay"


def test_an_index_of_another_model_is_refused(index_dir, model, text_encoder, tmp_path) -> None:
    twin = Mncl(text_encoder, model.config)  # the same shape, other weights
    save_retriever(twin, tmp_path, {})
    with pytest.raises(IndexMismatch, match="was built by model"):
        Localizer.open(index_dir, tmp_path)
    check_model(open_version(index_dir)[1], model.fingerprint)
