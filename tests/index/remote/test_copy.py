import gc
import json

import pytest

from index.answering.localizer import Localizer
from index.build.artifact import open_version, read_aliases, set_alias
from index.remote.copy import LocalCopy, copy_directory
from index.remote.place import Place
from index.remote.push import push
from models.errors import IndexBroken, RemoteUnavailable
from models.files import BUILDING, hold


class Holder:
    """What a service has open."""


def silent(*_):
    pass


def versions_in(root):
    return {path.name for path in root.iterdir() if path.is_dir()}


@pytest.fixture
def sent(index, bucket):
    """The index, in a bucket: files there and URL."""
    files, url = bucket
    push(index, Place(url), silent)
    return files, url


@pytest.mark.parametrize("kind", ["file", "memory", "http"])
def test_what_the_aliases_there_name_is_here_whole(index, request, kind, copy_of):
    if kind == "memory":
        _, url = request.getfixturevalue("sent")
    else:
        url = f"file://{index}" if kind == "file" else request.getfixturevalue("web_server")
    copy, root = copy_of(url)
    copy.refresh()
    directory, manifest = open_version(root)
    assert directory == root / "v1"
    assert {path.name for path in directory.iterdir()} == {*manifest.files, "manifest.json"}
    assert read_aliases(root).versions["v1"] == read_aliases(index).versions["v1"]
    assert versions_in(root) == {"v1"}, "what nothing names stays there"


def test_a_new_version_is_here_before_its_alias_moves_and_the_old_one_goes_when_nothing_serves_it(
    index, copy_of, monkeypatch
):
    copy, root = copy_of(f"file://{index}")
    copy.refresh()
    served, seen, fetch = Holder(), [], Place.fetch
    hold(root / "v1", served)

    def fetches(place, name, path):
        seen.append((name, dict(read_aliases(root).aliases), (root / "v2").exists()))
        fetch(place, name, path)

    monkeypatch.setattr(Place, "fetch", fetches)
    set_alias(index, "default", "v2")
    copy.refresh()
    assert len(seen) > 5
    assert all(aliases == {"default": "v1"} and not is_there for _, aliases, is_there in seen)
    assert read_aliases(root).aliases == {"default": "v2"}
    assert list(read_aliases(root).versions) == ["v2"]
    assert versions_in(root) == {"v1", "v2"}
    del served
    copy.refresh()
    assert versions_in(root) == {"v2"}
    assert len([name for name, *_ in seen if name.endswith("manifest.json")]) == 1, "what is here is not fetched again"


def test_an_open_index_keeps_its_version(index_dir, weights_dir, bucket, copy_of):
    _, url = bucket
    push(index_dir, Place(url), silent)
    copy, root = copy_of(url)
    copy.refresh()
    localizer = Localizer.open(root, weights_dir)
    version = localizer.manifest.version
    copy._remove_unused(set())
    assert versions_in(root) == {version}
    del localizer
    gc.collect()  # its parts name one another
    copy._remove_unused(set())
    assert versions_in(root) == set()


def test_an_alias_that_is_gone_there_goes_here(index, copy_of):
    set_alias(index, "canary", "v2")
    copy, root = copy_of(f"file://{index}")
    copy.refresh()
    assert read_aliases(root).aliases == {"default": "v1", "canary": "v2"}
    known = json.loads((index / "aliases.json").read_text())
    del known["aliases"]["canary"]
    (index / "aliases.json").write_text(json.dumps(known))
    copy.refresh()
    assert read_aliases(root).aliases == {"default": "v1"}
    assert versions_in(root) == {"v1"}


@pytest.mark.parametrize("kind", ["flipped", "cut", "gone", "manifest", "unregistered"])
def test_a_version_that_is_not_whole_there_is_named_and_leaves_nothing(sent, copy_of, index, kind):
    files, url = sent
    copy, root = copy_of(url)
    set_alias(index, "canary", "v2")
    push(index, Place(url), silent)
    name = "/bucket/town/v1/" + ("manifest.json" if kind == "manifest" else "vectors.faiss")
    whole = files.cat_file(name)
    if kind == "gone":
        files.rm_file(name)
    elif kind == "unregistered":
        known = json.loads(files.cat_file("/bucket/town/aliases.json"))
        del known["versions"]["v1"]
        files.pipe_file("/bucket/town/aliases.json", json.dumps(known).encode())
    else:
        files.pipe_file(name, whole[:-1] if kind == "cut" else bytes([whole[0] ^ 1]) + whole[1:])
    error = RemoteUnavailable if kind == "gone" else IndexBroken
    with pytest.raises(error, match="v1" if kind == "unregistered" else f"{url}/v1/{name.rpartition('/')[2]}"):
        copy.refresh()
    assert not list(root.glob(f"{BUILDING}*"))
    assert read_aliases(root).aliases == ({} if kind == "gone" else {"canary": "v2"}), "others move"
    if kind != "unregistered":
        files.pipe_file(name, whole)
        copy.refresh()
        assert open_version(root)[0].name == "v1"


def test_a_store_that_is_down_leaves_what_is_here(sent, copy_of, monkeypatch):
    files, url = sent
    copy, root = copy_of(url)
    copy.refresh()
    before = read_aliases(root)

    def fails(*_arguments, **_more):
        raise ConnectionError("no route")

    with monkeypatch.context() as patch:
        patch.setattr(type(files), "cat_file", fails)
        with pytest.raises(RemoteUnavailable, match=rf"{url}/aliases.json: no route; look whether"):
            copy.refresh()
    assert read_aliases(root) == before
    assert open_version(root)[0].name == "v1"


@pytest.mark.parametrize("content", [None, b"{}", b'{"aliases": {}, "versions": {}}'])
def test_where_no_index_is_says_how_one_gets_there(bucket, copy_of, content):
    files, url = bucket
    if content is not None:
        files.pipe_file("/bucket/town/aliases.json", content)
    with pytest.raises(RemoteUnavailable, match=rf"no index in {url}; .*hereabouts push"):
        copy_of(url)[0].refresh()


def test_aliases_there_that_are_torn_change_nothing(sent, copy_of):
    files, url = sent
    copy, root = copy_of(url)
    copy.refresh()
    before, whole = read_aliases(root), files.cat_file("/bucket/town/aliases.json")
    files.pipe_file("/bucket/town/aliases.json", whole[:-9])
    with pytest.raises(IndexBroken, match=rf"{url}/aliases.json is broken"):
        copy.refresh()
    assert read_aliases(root) == before


def test_what_is_broken_here_is_fetched_again(sent, copy_of):
    _, url = sent
    copy, root = copy_of(url)
    copy.refresh()
    (root / "v1" / "vectors.faiss").write_text("cut")
    (root / "aliases.json").write_text("{")
    copy.refresh()
    assert open_version(root)[0].name == "v1"


def test_one_process_of_a_machine_fetches(sent, copy_of, monkeypatch):
    _, url = sent
    copy, root = copy_of(url)
    other, fetch = LocalCopy(Place(url), root), Place.fetch

    def fetches(place, name, path):
        other.refresh()  # returns at once
        assert not (root / "aliases.json").exists()
        fetch(place, name, path)

    monkeypatch.setattr(Place, "fetch", fetches)
    copy.refresh()
    assert open_version(root)[0].name == "v1"


def test_each_url_has_a_copy_of_its_own(tmp_path):
    one, same, other = (copy_directory(tmp_path, f"s3://bucket/{name}") for name in ("a", "a", "b"))
    assert one == same != other
    assert one.is_relative_to(tmp_path)
