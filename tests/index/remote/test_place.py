from importlib.util import find_spec

import pytest

from index.remote.place import Place
from models.errors import RemoteUnavailable


@pytest.mark.parametrize(
    ("url", "package"),
    [("s3://bucket/town", "s3fs"), ("gs://bucket/town", "gcsfs"), ("sftp://host/town", "paramiko")],
)
def test_a_protocol_that_is_not_installed_says_what_to_install(url, package):
    if find_spec(package):
        pytest.skip(f"{package} is installed")
    with pytest.raises(RemoteUnavailable, match=f"{url} takes what is not installed: .*{package}"):
        Place(url)


def test_a_protocol_that_nobody_knows_says_which_there_are():
    with pytest.raises(RemoteUnavailable, match=r"s4://bucket/town is no URL of an index: .*give s3://bucket/town"):
        Place("s4://bucket/town")


def test_a_password_is_in_no_message():
    place = Place("http://me:secret-1@127.0.0.1:9/town")
    with pytest.raises(RemoteUnavailable) as failed:
        place.aliases()
    assert place.url == "http://127.0.0.1:9/town"
    assert "secret-1" not in place.url + str(failed.value)
