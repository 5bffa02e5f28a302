import pytest


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory):
    """Features of sentences are cached here and not in the home directory."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path_factory.mktemp("cache")))
        yield
