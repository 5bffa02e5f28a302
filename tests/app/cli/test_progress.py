import re

from app.cli.progress import stage_bars


def test_without_a_terminal_each_stage_is_one_line(capsys):
    with stage_bars() as show:
        show("read map", 0, 0)
        for done in range(3):
            show("cut [bold] cells", done, 3)
        show("read map", 0, 0)
    written = capsys.readouterr()
    assert written.out == ""
    first, second = written.err.splitlines()
    assert re.fullmatch(r" +0\.\d s  read map", first)
    assert re.fullmatch(r" +0\.\d s  cut \[bold\] cells", second)


def test_a_terminal_has_a_bar_for_each_stage(capsys, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    with stage_bars() as show:
        show("read map", 0, 0)
        show("cut cells", 3, 3)
    written = capsys.readouterr().err
    assert "\x1b[" in written
    assert "cut cells" in written
