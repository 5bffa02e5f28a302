"""The page below a path of another site: a visitor's main ways through it, behind nginx."""

import shutil
import subprocess
from contextlib import ExitStack, closing
from socket import socket

import pytest

from app.settings import Settings
from tests.app.conftest import is_ready, wait_until
from tests.app.web.conftest import served
from tests.app.web.test_asking import (  # noqa: F401
    test_a_place_that_is_pinned_is_described_and_found_again,
    test_who_asks_sees_the_answer_in_words_and_on_the_map,
)
from tests.app.web.test_page import SURE, test_an_evaluation_is_followed_and_its_errors_are_on_the_map  # noqa: F401

pytestmark = pytest.mark.slow
NGINX = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin")
KEY = "correct-horse"
CONFIG = """
daemon off; master_process off; pid {dir}/nginx.pid; error_log stderr;
events {{ worker_connections 256; }}
http {{
    access_log off; proxy_buffering off;
    proxy_set_header Host $http_host; proxy_set_header X-API-Key {key};
    client_body_temp_path {dir}/body; proxy_temp_path {dir}/proxy;
    fastcgi_temp_path {dir}/fastcgi; uwsgi_temp_path {dir}/uwsgi; scgi_temp_path {dir}/scgi;
    server {{ listen 127.0.0.1:{ports[0]}; location /town/ {{ proxy_pass {service}; }} }}
    server {{ listen 127.0.0.1:{ports[1]}; location /town/ {{ proxy_pass {service}/; }} }}  # removes /town
}}
"""


@pytest.fixture(scope="module")
def sites(town_index, warm, tmp_path_factory):
    """Two addresses of a service with the root path /town; nginx adds the key."""
    if NGINX is None:
        pytest.skip("no nginx here: apt-get install nginx")
    with ExitStack() as stack:
        url = stack.enter_context(served(Settings(index_dir=town_index, root_path="/town", read_key=KEY), warm))
        with ExitStack() as bound:
            free = [bound.enter_context(closing(socket())) for _ in range(2)]
            for each in free:
                each.bind(("127.0.0.1", 0))
            ports = [each.getsockname()[1] for each in free]
        folder = tmp_path_factory.mktemp("nginx")
        config = folder / "nginx.conf"
        config.write_text(CONFIG.format(dir=folder, ports=ports, service=url.rstrip("/"), key=KEY))
        nginx = stack.enter_context(subprocess.Popen([NGINX, "-p", folder, "-c", config, "-e", "stderr"]))
        stack.callback(nginx.terminate)
        wait_until(lambda: nginx.poll() is not None or is_ready(f"http://127.0.0.1:{ports[1]}/town"))
        assert nginx.poll() is None, "nginx did not start; its error is above"
        yield [f"http://127.0.0.1:{port}/town/" for port in ports]


@pytest.fixture
def service(sites):
    """The address for the tests that are imported above."""
    return sites[0]


def test_a_proxy_may_remove_the_path(visit, sites):
    visitor = visit(sites[1]).open()
    assert visitor.ask(SURE)["status"] == "ok"


def test_the_path_without_its_slash_leads_to_the_page_and_its_docs_to_the_api(visit, sites):
    page = visit(sites[0]).page
    page.goto(sites[0].removesuffix("/"))
    assert page.url == sites[0]
    page.goto(f"{sites[0]}docs")
    page.wait_for_selector("[data-path='/localize/batch']")
    assert page.inner_text("select") == "/town"
