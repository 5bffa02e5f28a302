import re
from dataclasses import replace

import pytest
from typer.testing import CliRunner

from app.cli.main import app
from app.cli.maps import print_index_summary, print_summary
from models.sources.osm.summary import load_gazetteer_and_summary


@pytest.fixture
def summary(osm_file):
    return load_gazetteer_and_summary(osm_file)[1]


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments], env={"COLUMNS": "80"})


def test_check_shows_a_map_on_a_screen_without_an_index(osm_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("check", osm_file)
    assert result.exit_code == 0
    assert re.search(r"^walkable +3\.6 km of streets and paths", result.stdout, re.MULTILINE)
    assert re.search(r"^streets +12 with a name", result.stdout, re.MULTILINE)
    assert re.search(r"^index +about \d+ s .*\d MB \(estimated", result.stdout, re.MULTILINE)
    assert re.search(r"^note +there are no house numbers", result.stdout, re.MULTILINE)
    assert len(result.stdout.splitlines()) <= 24
    assert list(tmp_path.iterdir()) == []


def test_check_shows_a_part_of_a_map(osm_file):
    result = run("check", osm_file, "--within", "25.0,60.0,25.0027,60.0013")
    assert re.search(r"map +tinytown.osm: 0.15 x 0.14 km", result.stdout)


@pytest.mark.parametrize(("name", "reason"), [("none.osm", "no such file"), ("", "")])
def test_check_of_no_map_says_what_to_give(tmp_path, name, reason):
    result = run("check", tmp_path / name)
    assert (result.exit_code, len(result.stderr.splitlines())) == (1, 1)
    assert reason in result.stderr


def test_reasons_and_what_is_missing_are_shown(summary, capsys):
    empty = replace(summary, streets=0, walkable_km=0, dropped={"the outline is broken": 1200}, repaired={"ids": 3})
    print_summary("m", empty, "-")
    shown = capsys.readouterr().out
    assert re.search(r"^dropped +1,200: the outline is broken", shown, re.MULTILINE)
    assert re.search(r"^repaired +3: ids", shown, re.MULTILINE)
    assert "no street has a name" in shown
    assert "nobody can stand anywhere" in shown


def test_an_index_shows_the_summary_of_its_map_with_its_cost(index_dir, summary, capsys):
    [version] = [path for path in index_dir.iterdir() if path.is_dir()]
    print_index_summary(version)
    shown = capsys.readouterr().out
    assert re.search(r"^map +tinytown: 0.3\d x 0.3\d km", shown, re.MULTILINE)
    assert re.search(r"^index +[\d,]+ cells, [\d.]+ MB", shown, re.MULTILINE)
