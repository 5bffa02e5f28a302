import pytest

from index.build.artifact import open_version, read_aliases, set_alias
from index.remote.place import Place
from index.remote.push import push
from models.errors import IndexBroken, RemoteUnavailable
from tests.versions import write_version


def silent(*_):
    pass


@pytest.fixture
def written(monkeypatch):
    """The names that are written, in their order."""
    names, send, name = [], Place.send, Place.name
    monkeypatch.setattr(Place, "send", lambda place, path, to: (names.append(to), send(place, path, to)))
    monkeypatch.setattr(Place, "name", lambda place, aliases: (names.append("aliases"), name(place, aliases)))
    return names


def test_files_then_the_manifest_then_the_aliases(index, tmp_path, written):
    to = tmp_path / "shared" / "town"
    push(index, Place(f"file://{to}"), silent)
    directory, manifest = open_version(to)
    assert written == [*(f"v1/{name}" for name in manifest.files), "v1/manifest.json", "aliases"]
    assert directory == to / "v1"
    assert read_aliases(to).versions == {"v1": read_aliases(index).versions["v1"]}


def test_what_is_there_is_not_sent_again_and_others_stay(index, bucket, written, tmp_path):
    _, url = bucket
    other = tmp_path / "other"
    other.mkdir()
    write_version(other / "b1")
    set_alias(other, "berlin", "b1")
    push(index, Place(url), silent)
    push(other, Place(url), silent)
    written.clear()
    set_alias(index, "default", "v2")
    there = push(index, Place(url), silent)
    assert there.aliases == {"default": "v2", "berlin": "b1"}
    assert set(there.versions) == {"v1", "v2", "b1"}
    assert Place(url).aliases() == there
    assert {name.partition("/")[0] for name in written} == {"v2", "aliases"}
    written.clear()
    push(index, Place(url), silent)
    assert written == ["aliases"]


def test_what_is_broken_is_not_sent(index, bucket, written):
    files, url = bucket
    (index / "v1" / "cells.json").write_text("CELLS.json"[::-1])
    with pytest.raises(IndexBroken, match=r"cells.json was changed"):
        push(index, Place(url), silent)
    assert written == []
    assert not files.exists("/bucket/town/aliases.json")


def test_a_push_that_fails_moves_no_alias(index, bucket, monkeypatch):
    files, url = bucket
    push(index, Place(url), silent)
    before = Place(url).aliases()
    set_alias(index, "default", "v2")
    put = type(files).put_file

    def fails(self, path, name, **more):
        if name.endswith("manifest.json"):
            raise PermissionError("not yours")
        put(self, path, name, **more)

    with monkeypatch.context() as patch:
        patch.setattr(type(files), "put_file", fails)
        with pytest.raises(RemoteUnavailable, match=r"v2/manifest.json: not yours"):
            push(index, Place(url), silent)
    assert Place(url).aliases() == before
    assert push(index, Place(url), silent).aliases == {"default": "v2"}


def test_no_index_is_a_clear_error(tmp_path, bucket):
    with pytest.raises(IndexBroken, match=r"no index in .*; build it with"):
        push(tmp_path, Place(bucket[1]), silent)


def test_a_web_server_that_takes_nothing_says_so(index, web_server, tmp_path):
    write_version(index / "v3")
    set_alias(index, "default", "v3")
    (index / "aliases.json").rename(tmp_path / "aliases.json")  # what is there is another index
    place = Place(web_server)
    assert place.aliases() is None
    (tmp_path / "v3").symlink_to(index / "v3")
    with pytest.raises(RemoteUnavailable, match=f"{web_server}/v3/"):
        push(tmp_path, place, silent)
