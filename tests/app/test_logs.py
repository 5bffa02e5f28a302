import logging

import pytest

from app.logs import configure_logging


@pytest.fixture
def _as_before():
    root = logging.getLogger()
    before = root.level, root.handlers[:]
    yield
    root.setLevel(before[0])
    root.handlers[:] = before[1]
    logging.getLogger("faiss.loader").setLevel(logging.NOTSET)


@pytest.mark.usefixtures("_as_before")
@pytest.mark.parametrize("level", ["debug", "info", "warning", "error"])
def test_faiss_tells_which_build_it_loads_when_debugging_alone(level, capsys) -> None:
    configure_logging(level)
    loader = logging.getLogger("faiss.loader")
    loader.info("Loading faiss with AVX2 support.")
    assert ("AVX2" in capsys.readouterr().err) == (level == "debug")
    loader.warning("it is broken")
    assert ("broken" in capsys.readouterr().err) == (level != "error")
    logging.getLogger("app").info("ours")
    assert ("ours" in capsys.readouterr().err) == (level in ("debug", "info"))
