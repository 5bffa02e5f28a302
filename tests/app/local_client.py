"""A test client that the service takes for a program on its own machine."""

from fastapi.testclient import TestClient


def local_client(app, **options):
    """Return a client whose address and Host header are loopback, as `curl localhost:8000` has them."""
    return TestClient(app, base_url="http://127.0.0.1:8000", client=("127.0.0.1", 50_000), **options)
