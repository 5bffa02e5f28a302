import pytest

from index.build.artifact import register
from tests.versions import write_version


@pytest.fixture(scope="module")
def versions_dir(tmp_path_factory):
    """An index directory without a model's work in it; v1 is registered, and no alias names it."""
    root = tmp_path_factory.mktemp("index")
    write_version(root / "v1")
    register(root, "v1")
    return root
