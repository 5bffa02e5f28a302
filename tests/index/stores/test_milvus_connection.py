import pytest

from index.stores import milvus_connection
from index.stores.milvus_connection import URI, MilvusConnection
from models.errors import StoreUnavailable


def test_without_the_extra_it_says_what_to_install(monkeypatch) -> None:
    monkeypatch.setattr(milvus_connection, "find_spec", lambda name: None)
    with pytest.raises(StoreUnavailable, match=r"pip install 'hereabouts\[milvus\]'"):
        MilvusConnection()


def test_without_an_address_it_says_what_to_set(monkeypatch) -> None:
    monkeypatch.setattr(milvus_connection, "find_spec", lambda name: name)
    for unset in (lambda: monkeypatch.delenv(URI, raising=False), lambda: monkeypatch.setenv(URI, "")):
        unset()
        with pytest.raises(StoreUnavailable, match=f"{URI}=http://"):
            MilvusConnection()


@pytest.mark.parametrize("address", ["http://127.0.0.1:1", "milvus://127.0.0.1:1", "http://127.0.0.1"])
def test_an_address_where_nothing_is_names_the_setting_and_no_password(monkeypatch, address) -> None:
    pytest.importorskip("pymilvus", reason="pymilvus not installed: pip install 'hereabouts[dev]'")
    monkeypatch.setattr(milvus_connection, "CONNECT_TIMEOUT_S", 0.2)
    monkeypatch.setenv(URI, address.replace("//", "//root:a-password@"))
    with pytest.raises(StoreUnavailable, match=rf"cannot list_collections: .* {URI} names") as raised:
        MilvusConnection().call("list_collections")
    assert "a-password" not in str(raised.value)
