"""hereabouts alias: names of index versions, and what cannot be used as one."""

import errno
import os
import shutil

import pytest
from typer.testing import CliRunner

from app.cli.main import app
from index.build import artifact
from index.build.artifact import read_aliases
from tests.versions import write_index, write_version


@pytest.fixture
def root(tmp_path):
    """An index directory: v1 is the default, v2 has no name, and `copied` is not registered."""
    root = write_index(tmp_path / "index")
    write_version(root / "copied")
    return root


@pytest.fixture
def alias(root):
    """Runs `hereabouts alias` on the index directory and returns the exit code, stdout and stderr."""

    def run(*arguments):
        result = CliRunner().invoke(app, ["alias", *arguments, "--index", str(root)], env={"COLUMNS": "200"})
        assert "Traceback" not in result.output
        assert not isinstance(result.exception, Exception), result.exception
        return result.exit_code, result.stdout, " ".join(result.stderr.split())

    return run


def test_list_prints_aliases_then_versions_without_one(alias):
    assert alias("list") == (0, "default\tv1\n-\tcopied\n-\tv2\n", "")


def test_set_registers_a_copied_version_and_names_it(alias, root):
    code, message, _ = alias("set", "canary", "copied")
    assert code == 0
    assert message.startswith("canary names copied; ")
    assert alias("set", "default", "v2")[0] == 0
    known = read_aliases(root)
    assert known.aliases == {"canary": "copied", "default": "v2"}
    assert sorted(known.versions) == ["copied", "v1", "v2"]


def test_remove_takes_the_name_and_leaves_the_version(alias, root):
    alias("set", "canary", "v2")
    code, message, _ = alias("remove", "canary")
    assert code == 0
    assert message.startswith("canary is removed; ")
    assert read_aliases(root).aliases == {"default": "v1"}
    assert alias("list")[1] == "default\tv1\n-\tcopied\n-\tv2\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("set", "default", "v3"), "no version v3 in {root}; its versions are copied, v1, v2"),
        (("set", "default", "../v1"), "no version ../v1 in {root}"),
        (("set", "a/b", "v1"), "'a/b' is not a name for an alias; use letters, digits"),
        (("remove", "canary"), "no alias canary in {root}; its aliases are default"),
        (("remove", "default"), "default cannot be removed; let it name another version with 'hereabouts alias set'"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_changes_nothing(alias, root, arguments, message):
    before = (root / "aliases.json").read_bytes()
    code, out, error = alias(*arguments)
    assert (code, out) == (1, "")
    assert message.format(root=root) in error
    assert (root / "aliases.json").read_bytes() == before


def test_a_broken_version_gets_no_name(alias, root):
    for version, problem in (("copied", "was changed"), ("v2", "cut short")):
        path = root / version / "cells.json"
        path.write_text("X" * len(path.read_text()) if version == "copied" else "")
        code, _, error = alias("set", "default", version)
        assert code == 1
        assert f"{version}/cells.json" in error
        assert problem in error
    assert read_aliases(root).aliases == {"default": "v1"}
    assert "copied" not in read_aliases(root).versions


def test_a_directory_without_an_index_is_said_and_stays_empty(alias, root):
    shutil.rmtree(root)
    root.mkdir()
    for arguments in (("list",), ("set", "default", "v1"), ("remove", "canary")):
        code, _, error = alias(*arguments)
        assert code == 1
        assert str(root) in error
    assert list(root.iterdir()) == []


@pytest.mark.parametrize("error", [errno.EROFS, errno.ENOSPC])
def test_a_directory_that_cannot_be_written_is_said_and_nothing_changes(alias, root, monkeypatch, error):
    alias("set", "canary", "v2")
    before = (root / "aliases.json").read_bytes()

    def fails(*_arguments):
        raise OSError(error, os.strerror(error), str(root))

    monkeypatch.setattr(artifact, "replace_file", fails)
    for arguments in (("set", "default", "copied"), ("set", "default", "v2"), ("remove", "canary")):
        code, _, message = alias(*arguments)
        assert code == 1
        assert f"{root} cannot be written" in message
    assert (root / "aliases.json").read_bytes() == before
