"""The tutorial and the how-tos: every block is sound (fast), and all of a page run in order as they stand (slow)."""

import importlib
import re
import tomllib

import pytest

from tests.pages import PAGES, blocks, commands, file_of


def printed_as_shown(printed, shown):
    """Words exactly, numbers to two units of the last digit (another machine rounds otherwise)."""
    number = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
    assert re.sub(number, "#", printed).split() == re.sub(number, "#", shown).split()
    for found, said in zip(re.findall(number, printed), re.findall(number, shown), strict=True):
        if "e" not in said:
            assert float(found) == pytest.approx(float(said), abs=2.01 * 10.0 ** -len(said.partition(".")[2]))


@pytest.mark.parametrize("page", PAGES)
def test_every_block_is_sound(page, tmp_path, monkeypatch):
    """Python compiles, TOML parses, and commands are orders without a fault."""
    monkeypatch.chdir(tmp_path)
    kinds = []
    for kind, text in blocks(page):
        kinds.append(kind)
        if kind == "python":
            compile(text, page, "exec")
        elif kind == "toml":
            tomllib.loads(text)
            if name := file_of(text):
                (tmp_path / name).write_text(text)
        elif kind == "sh":
            for module, words in commands(text):
                if module == "analysis":
                    from campaigns.time_series import parser

                    assert parser().parse_args(words).column
                else:
                    faults = []
                    importlib.import_module(module).read_order(words, faults)
                    assert faults == []
        else:
            assert kind == "text"
    assert "python" in kinds


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
def test_the_page_runs_from_top_to_bottom(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names, printed = {"__name__": "page"}, ""
    for kind, text in blocks(page):
        if kind == "text":
            printed_as_shown(printed, text)
        elif kind == "toml" and (name := file_of(text)):
            (tmp_path / name).write_text(text)
        elif kind == "python":
            capsys.readouterr()
            exec(compile(text, page, "exec"), names)
            printed = capsys.readouterr().out
        elif kind == "sh":
            for module, words in commands(text):
                entry = "campaigns.time_series" if module == "analysis" else module
                assert importlib.import_module(entry).main(words) == 0
