"""The snaps of a measured tension: as a page of plain text, and as the files of `--out`.

answer.txt          the page
snaps.csv           a row a snap; snaps_columns.csv says what its columns are
"""

from pathlib import Path

import numpy as np

from analysis import Snaps, detect_snaps
from campaigns.time_series.record import Record
from engine.atomic import write_atomic
from tables import ANSWER, Column, names, write_table

SHOWN = 20  # snaps that a page lists
COLUMNS = (
    Column("onset_s", "s", "onset", "when the slack interval began; empty if before the record", 3),
    Column("duration_s", "s", "slack", "length of the slack interval", 3),
    Column("taut_s", "s", "taut", "when the line became taut", 3),
    Column("peak_N", "N", "peak", "largest tension of the pull, ringing included", 0),
    Column("peak_s", "s", "peak at", "time of the peak", 3),
    Column("rise_s", "s", "rise", "time from taut to the peak", 3),
    Column("peak_over_static", "", "peak/T_s", "peak over the static tension", 3),
)


def snaps_in(record: Record, options: dict[str, float]) -> Snaps:
    """`analysis.detect_snaps` of a record; its mean is the static tension where options do not say another."""
    return detect_snaps(record.values, record.step, **{"static_N": record.values.mean(), **options})


def snap_page(record: Record, found: Snaps) -> str:
    """The text: how many, by which thresholds, how large; the largest snaps."""
    lines = [f"{record.path}, column {record.column}: {found} (static: {found.static_N:.4g} N)"]
    if not len(found):
        low_N, high_N = record.values.min(), record.values.max()
        return f"{lines[0]}\nthe tension lies between {low_N:.4g} and {high_N:.4g} N"
    hours = found.watched_s / 3600.0
    peaks = found.peak_N
    lines.append(
        f"{len(found) / hours:.4g} an hour; peaks: median {np.median(peaks):.4g} N, "
        f"95 % {np.quantile(peaks, 0.95):.4g} N, largest {peaks.max():.4g} N at {found.peak_s[peaks.argmax()]:.6g} s"
    )
    lines.append("times from the first sample (s), tensions (N):")
    lines.append("".join(f"{column.symbol:>12}" for column in COLUMNS))
    for place in np.sort(np.argsort(-peaks, kind="stable")[:SHOWN]):
        entries = (getattr(found, name)[place] for name in names(COLUMNS))
        lines.append("".join(f"{entry:12.5g}" for entry in entries))
    if len(found) > SHOWN:
        lines.append(f"the {SHOWN} largest of {len(found)}")
    return "\n".join(lines)


def write_snaps(out: Path, text: str, found: Snaps) -> None:
    """Write the page and the table into a folder, which is made. Raises OSError."""
    out.mkdir(parents=True, exist_ok=True)
    write_atomic(out / ANSWER, f"{text}\n".encode())
    write_table(out / "snaps.csv", COLUMNS, found.table().to_dict("records"))
