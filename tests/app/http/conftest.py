import pytest

from index.build.artifact import register
from tests.versions import write_version


@pytest.fixture(scope="module")
def versions_dir(tmp_path_factory):
    """An index directory without a model's work in it: v1 is registered, copied is whole, broken was changed."""
    root = tmp_path_factory.mktemp("index")
    for version in ("v1", "copied", "broken"):
        write_version(root / version)
    register(root, "v1")
    (root / "broken" / "cells.json").write_text("changed")
    return root
