"""Machine code that is kept is that of the sources as they are."""

import importlib
import sys

import pytest

from models.compiled import _source

CALLED = (
    "from models.compiled import compiled\nFACTOR = {factor}\n\n@compiled\ndef helped(x):\n    return x * {times}\n"
)
CALLS = """from models.compiled import compiled
from called_{name} import FACTOR, helped


@compiled
def asked(x):
    return helped(x) + FACTOR
"""


@pytest.fixture
def ask(tmp_path, monkeypatch):
    """Asks a module that calls another, of which is said what it is, as a new process does: (answer, cache hits)."""
    name = tmp_path.name
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / f"calls_{name}.py").write_text(CALLS.format(name=name))

    def questions_put(**phrase):
        (tmp_path / f"called_{name}.py").write_text(CALLED.format(**phrase))
        for module in (f"called_{name}", f"calls_{name}"):
            sys.modules.pop(module, None)
        importlib.invalidate_caches()
        _source.cache_clear()
        function = importlib.import_module(f"calls_{name}").asked
        return function(10), sum(function.stats.cache_hits.values())

    return questions_put


def test_machine_code_is_kept_until_what_it_calls_or_takes_from_elsewhere_changes(ask, monkeypatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)  # its stamps are as coarse as a second
    assert ask(times=2, factor=1) == (21, 0)
    assert ask(times=2, factor=1) == (21, 1)
    assert ask(times=3, factor=1) == (31, 0), "the function that it calls"
    assert ask(times=3, factor=5) == (35, 0), "a number"
    assert ask(times=2, factor=1) == (21, 1), "and back"
