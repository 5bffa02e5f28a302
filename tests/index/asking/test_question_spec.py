import pytest

from index.asking.question_spec import MAX_CHOICES, OPEN_QUESTIONS, OTHER, UNKNOWN, QuestionSpec
from models.language.languages.translation import replies_in
from models.language.lexicon.lexicon import load_lexicon
from models.language.lexicon.question_classes import load_question_classes

ALL = [
    QuestionSpec("near", ("tree",)),
    QuestionSpec("way", ("street lamp",)),
    QuestionSpec("colour", ("building", "red", "gray")),
    QuestionSpec("street"),
    QuestionSpec("name"),
    QuestionSpec("corner"),
    QuestionSpec("address"),
]


@pytest.mark.parametrize("spec", ALL)
def test_an_id_says_all(spec):
    assert QuestionSpec.parse(spec.id) == spec


@pytest.mark.parametrize(
    "wrong",
    [
        *("", "near", "near:", "far:tree", "street:", "street:A", "name:Stockmann", "corner:A|B", "address:1 A"),
        *("colour:building", "colour:building|", "colour:building|red|red", "colour:building|a|b|c|d|e"),
    ],
)
def test_what_is_no_id(wrong):
    assert MAX_CHOICES == 4
    assert QuestionSpec.parse(wrong) is None


def test_questions_in_words():
    texts = [spec.question().text for spec in ALL]
    assert texts == [
        "Is there a tree within about 10 metres of you?",
        "In which direction is the nearest street lamp?",
        "What colour is the nearest building?",
        "Which street are you on?",
        "What is the name of a shop or another place that you can see?",
        "What is the nearest cross street?",
        "What is the number and street of the house nearest to you?",
    ]


@pytest.mark.parametrize("spec", ALL)
def test_choices_are_the_values_and_unknown(spec):
    question = spec.question()
    assert question.id == spec.id
    assert [choice.value for choice in question.choices] == [*spec.values, UNKNOWN]
    assert len({choice.text for choice in question.choices}) == len(question.choices)
    assert (OTHER in spec.values) == (spec.kind == "colour")
    assert question.is_open == (spec.kind in OPEN_QUESTIONS)


def test_an_open_question_offers_names():
    question = QuestionSpec("street").question(["Unioninkatu", "A: B | C"])
    assert [(choice.value, choice.text) for choice in question.choices] == [
        ("Unioninkatu", "Unioninkatu"),
        ("A: B | C", "A: B | C"),
        (UNKNOWN, "I don't know"),
    ]
    assert question.id == "street"


def test_only_classes_of_maps_are_asked_about():
    assert set(load_question_classes().things) <= set(load_lexicon().labels) - load_lexicon().elsewhere


@pytest.mark.parametrize(
    ("code", "texts", "choices"),
    [
        (
            "fi",
            ("Onko noin 10 metrin säteellä puu?", "Missä suunnassa on lähin katuvalo?", "Millä kadulla olet?"),
            ("Punainen", "Harmaa", "Jokin muu väri", "En tiedä"),
        ),
        (
            "sv",
            (
                "Finns det ett träd inom ungefär 10 meter från dig?",
                "Åt vilket håll ligger närmaste gatlykta?",
                "Vilken gata är du på?",
            ),
            ("Röd", "Grå", "En annan färg", "Jag vet inte"),
        ),
        (
            "de",
            (
                "Gibt es im Umkreis von etwa 10 Metern einen Baum?",
                "In welcher Richtung ist die nächste Straßenlaterne?",
                "In welcher Straße sind Sie?",
            ),
            ("Rot", "Grau", "Eine andere Farbe", "Ich weiß es nicht"),
        ),
        (
            "fr",
            (
                "Y a-t-il un arbre à moins de 10 mètres de vous environ\u00a0?",
                "Dans quelle direction se trouve le réverbère le plus proche\u00a0?",
                "Dans quelle rue êtes-vous\u00a0?",
            ),
            ("Rouge", "Gris", "Une autre couleur", "Je ne sais pas"),
        ),
        (
            "es",
            (
                "¿Hay un árbol en un radio de unos 10 metros?",
                "¿En qué dirección está la farola más cercana?",
                "¿En qué calle estás?",
            ),
            ("Rojo", "Gris", "Otro color", "No lo sé"),
        ),
    ],
)
def test_questions_in_other_languages(code, texts, choices):
    english = ALL[2].question()
    with replies_in(code):
        assert tuple(ALL[n].question().text for n in (0, 1, 3)) == texts
        colour = ALL[2].question()
    assert tuple(choice.text for choice in colour.choices) == choices
    assert colour.id == english.id
    assert [choice.value for choice in colour.choices] == [choice.value for choice in english.choices]
