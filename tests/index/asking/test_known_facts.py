import numpy as np

from index.asking.known_facts import KnownFacts
from models.language.mentions.mentions import Mention
from tests.models.citymap.gazetteer.made_town import made_gazetteer


def test_names_are_those_of_streets_and_of_whole_names() -> None:
    gazetteer = made_gazetteer()
    number = {name: n for n, words in enumerate(gazetteer.objects) for name in words.names}
    street = Mention("W 25th", 0, 6, "street", np.array([number["West 25th Street"]]), np.ones(1))
    whole = Mention("Elmo", 7, 11, "thing", np.array([number["Elmo"]]), np.ones(1), is_exact=True)
    part = Mention("Rossi", 12, 17, "thing", np.array([number["Rossi Bakery"]]), np.ones(1))
    facts = KnownFacts.from_text(None, [street, whole, part], [], gazetteer)
    assert {"West 25th Street", "Elmo"} <= facts.names
    assert "Rossi Bakery" not in facts.names
