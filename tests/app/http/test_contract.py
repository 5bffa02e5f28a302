"""The service does what its OpenAPI document says, whatever it is sent (schemathesis); FUZZ_EXAMPLES sets how often."""

import os

import pytest
import schemathesis
from fake_localizer import Steady
from hypothesis import HealthCheck, settings
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import negative_data_rejection, positive_data_acceptance

from app.main import create_app
from app.settings import Settings

EXAMPLES = int(os.environ.get("FUZZ_EXAMPLES", "20"))
GEOCODER = ("/search", "/reverse", "/lookup", "/status")
SOON_MS = 200  # who wants an answer within less may be told that there was none


schema = schemathesis.openapi.from_dict(create_app(Settings()).openapi())


@pytest.fixture(scope="module")
def url(in_a_thread, tmp_path_factory):
    with in_a_thread(create_app(Settings(index_dir=tmp_path_factory.mktemp("index")), Steady)) as port:
        yield f"http://127.0.0.1:{port}"


@pytest.mark.slow
@schema.parametrize()
@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
def test_every_operation_keeps_its_word(case, url):
    response = case.call(base_url=url)
    left_out = [positive_data_acceptance]  # that a text has words, or degrees are on Earth, no schema can say
    if response.status_code == 413 or case.path in GEOCODER:
        left_out.append(
            negative_data_rejection
        )  # it does not know 413 for a refusal; geocoders ignore empty parameters
    if response.status_code == 504 and isinstance(case.body, dict) and case.body.get("deadline_ms", SOON_MS) < SOON_MS:
        left_out.append(not_a_server_error)
    case.validate_response(response, excluded_checks=left_out)
