"""The campaign of the whole paper: its parts are run once, found again, and what stops one stops all."""

import json
import shutil
from collections import Counter
from itertools import product
from pathlib import Path

import pytest

from campaigns import paper
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.plan import Summary
from campaigns.paper import dependence, parts, results
from campaigns.paper.figures import FIGURES, place_of
from engine import load_scene
from reports.paper.figures import figures_of, left_out, pictures
from tests.campaigns.conftest import rows_of
from tests.processes import OTHERWISE, python


@pytest.fixture
def campaign(tmp_path, monkeypatch):
    """campaign(*words) -> (exit code, parts begun); parts in `ends` end as it says. Nothing is simulated."""
    begun, ends, out = [], {}, tmp_path / "out"

    def part(name, module, words):
        begun.append(name)
        if name in ends:
            raise ends[name]
        folder = Path(words[words.index("--out") + 1])
        leave(folder)
        provenance_of_part = {"timing": {"compile_s": 1.0, "run_s": 2.0}, "runs": {"total": 1, "failed": 0}}
        (folder / "provenance.json").write_text(json.dumps(provenance_of_part))
        (folder / "report.html").write_text("")

    def depends(folder, jobs, quick):
        begun.append("dependence")
        leave(folder)
        return Summary([{"status": "ok"}], 0, 1, Counter(run_s=1.0))

    monkeypatch.setattr(parts, "_run_campaign", part)
    monkeypatch.setattr(dependence, "run", depends)
    monkeypatch.setattr(results, "write", lambda folder: begun.append("writing"))
    monkeypatch.setattr(results, "is_there", lambda folder, report: True)

    def run(*words):
        begun.clear()
        code = paper.main([*words, "--out", str(out), "--no-report"])
        return code, list(begun)

    run.out, run.ends = out, ends
    return run


def leave(folder):
    (folder / "trajectories").mkdir(parents=True, exist_ok=True)
    (folder / "trajectories" / "key.nc").write_text("")
    (folder / "table.csv").write_text("status,run_key\nok,key\n")


def rows(out):
    return {row["part"]: row for row in rows_of(out)}


def test_every_part_is_run_once_and_then_found(campaign):
    assert campaign() == (0, [*paper.PARTS, "writing"])
    earlier = (campaign.out / "table.csv").read_bytes()
    provenance = (campaign.out / "provenance.json").read_bytes()
    assert campaign() == (0, [])
    assert (campaign.out / "table.csv").read_bytes() == earlier
    assert (campaign.out / "provenance.json").read_bytes() == provenance
    assert campaign("--jobs", "1") == (0, [])


@pytest.mark.parametrize(
    ("tables", "content"),
    [
        (("buoy/table.csv", "sweep/table.csv"), ""),
        # a part that was killed when begun again: its table is sound at every moment, and too short
        (("buoy/table.csv", "sweep/close_up/table.csv"), "status,run_key\nok,key\nok,key\n"),
    ],
)
def test_a_part_is_run_again_where_a_table_of_it_is_gone_or_other(campaign, tables, content):
    campaign()
    for table in tables:
        (campaign.out / table).parent.mkdir(exist_ok=True)
        (campaign.out / table).write_text(content)
    assert campaign() == (0, ["buoy", "sweep", "writing"])


def test_a_part_is_run_again_where_a_run_is_gone_and_all_where_the_words_are_others(campaign):
    campaign()
    (campaign.out / "oscillator" / "trajectories" / "key.nc").unlink()
    assert campaign() == (0, ["oscillator", "writing"])
    assert campaign("--quick") == (0, [*paper.PARTS, "writing"])


def test_parts_chosen_are_run_beside_those_that_are_there(campaign):
    assert campaign("--parts", "oscillator", "buoy") == (0, ["buoy", "oscillator", "writing"])
    assert campaign("--parts", "sweep") == (0, ["sweep", "writing"])
    assert list(rows(campaign.out)) == ["buoy", "sweep", "oscillator"]


@pytest.mark.parametrize(("ended", "code"), [(CampaignStopped("the disk is full"), 1), (KeyboardInterrupt(), 130)])
def test_what_stops_a_part_stops_the_campaign_and_keeps_what_is_done(campaign, ended, code):
    campaign.ends["sweep"] = ended
    assert campaign() == (code, ["breaking_line", "buoy", "doubled", "sweep"])
    assert list(rows(campaign.out)) == ["breaking_line", "buoy", "doubled"]
    campaign.ends.clear()
    assert campaign() == (0, ["sweep", "dependence", "out_of_plane", "oscillator", "writing"])


def test_the_study_varies_one_thing_at_a_time_from_the_shipped_scene():
    all_variants, (above, drowned) = dependence.variants(False), dependence.treatments()
    scenes = (load_scene("tethered_buoy", keys) for keys in (dependence.changes(all_variants[0]), dependence.CARRIED))
    assert len({scene.key() for scene in scenes}) == 1  # it leads
    EI = all_variants[0][-1]
    for kA in (0.016, 0.13):
        usual = {values[1:4] for values in all_variants if (values[0], values[4]) == (kA, EI)}
        assert usual == {*product(dependence.DEPTHS_M, above, drowned)}
    assert len(set(all_variants)) == len(all_variants)


def assert_drawn_alike_elsewhere(out, elsewhere):
    """Figures are drawn from their files alone, by another process, with the same bytes."""
    shutil.copytree(place_of(out), place_of(elsewhere))
    code = (
        "import sys\nfrom pathlib import Path\nfrom reports.paper.figures import pictures\n"
        "for path, content in pictures(Path(sys.argv[1])).items():\n    path.write_bytes(content)\n"
    )
    assert python("-c", code, elsewhere, **OTHERWISE).returncode == 0
    drawn = pictures(out)
    assert len(drawn) == 2 * len(FIGURES)
    for path, content in drawn.items():
        assert (place_of(elsewhere) / path.name).read_bytes() == content
        assert len(content) < 500_000


@pytest.mark.slow
def test_a_quick_look_at_everything(tmp_path, capsys):
    out = tmp_path / "out"
    words = ["--quick", "--jobs", "2", "--out", str(out)]
    assert paper.main(words) == 0
    assert {row["status"] for row in rows(out).values()} == {"ok"} and list(rows(out)) == list(paper.PARTS)
    heads = {number: figure.caption.partition(" of the paper")[0] for number, figure in figures_of(out).items()}
    assert heads == {number: f"Fig. {number}" for number in FIGURES} and left_out(out) == {}
    page = (out / "report.html").read_text(encoding="utf-8")
    assert all(f"{head} of the paper" in page for head in heads.values())
    assert_drawn_alike_elsewhere(out, tmp_path / "elsewhere")
    verdicts = {row["statement"]: row["verdict"] for row in rows_of(out, "statements.csv")}
    assert verdicts["The maximum speed does not depend on the fracture time."] == "holds"
    assert verdicts["At high tension the front runs at about 500 m/s."] == "does not hold"
    assert verdicts["In large waves the largest Lyapunov exponent is positive."] == "–"
    content = {path: path.read_bytes() for path in out.rglob("*") if path.is_file() and path.name != ".lock"}
    capsys.readouterr()
    assert paper.main(words) == 0
    assert "0 computed, 7 found" in capsys.readouterr().out
    assert {path: path.read_bytes() for path in content} == content
