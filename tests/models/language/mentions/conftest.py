import pytest

from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.languages.english import English
from models.language.mentions.cue_reader import CueReader
from models.language.mentions.lookup import Lookup
from models.posterior.model import load_posterior
from tests.models.citymap.gazetteer.made_town import is_common, made_gazetteer


@pytest.fixture(scope="session")
def town() -> Gazetteer:
    return made_gazetteer()


@pytest.fixture(scope="session")
def lookup(town: Gazetteer) -> Lookup:
    return Lookup(town, load_vocabulary(), is_common)


@pytest.fixture(scope="session")
def cues() -> CueReader:
    return load_posterior().cues


@pytest.fixture(scope="session")
def english(cues: CueReader) -> English:
    return English(cues)
