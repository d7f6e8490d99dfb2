"""A Study as a page of plain text: what was given, what was found with its error, the verdict, and why."""

import re
import textwrap

import numpy as np

from analysis.exponents import Exponent
from campaigns.time_series.section import MAXIMA, SAMPLES, STROBED
from campaigns.time_series.study import Study

WIDTH = 100
MARK = {True: "yes", False: "no", None: "--"}
CYCLE = {STROBED: ("period", "periods"), SAMPLES: ("sample", "samples"), MAXIMA: ("maximum", "maxima")}
SEEN = {
    STROBED: "once per forcing period, at four phases of it",
    SAMPLES: "sample by sample, as a map",
    MAXIMA: "at its maxima, as no --period was given",
}
MEANING = {
    "quasi-periodic": "two or more rhythms that never meet; no sensitivity to the start",
    "chaotic": "deterministic, and neighbouring states part exponentially",
    "transient": "the motion has not settled: cut its beginning, or record longer",
    "undecided": "neither regular nor shown to be chaotic: noise, too short a record, or both at once",
}


def page(study: Study) -> str:
    """The text, without a last newline."""
    head = f"{study.record.path}, column {study.record.column}"
    parts = [[head, *_rows(_given(study))], _rows(_found(study)), _rows(_verdict(study)), _evidence(study)]
    parts.append([line for note in _notes(study) for line in _wrapped(f"note: {note}", 6)])
    return "\n\n".join("\n".join(part) for part in parts if part)


def number(value: float | None, error: float | None = None) -> str:
    """A value with the digits that its error leaves, or four; "none" where there is no value."""
    if value is None or not np.isfinite(value):
        return "none"
    if error is None or not np.isfinite(error) or error <= 0.0:
        return f"{value:.4g}"
    digits = int(np.clip(1 - np.floor(np.log10(error)), 0, 12))
    return f"{value:.{digits}f} +- {error:.{digits}f}"


def _wrapped(text: str, indent: int) -> list[str]:
    return textwrap.wrap(text, WIDTH, subsequent_indent=" " * indent, break_long_words=False)


def _rows(pairs: list[tuple[str, str]]) -> list[str]:
    """Lines of names in front and texts beside them."""
    return [line for name, text in pairs for line in _wrapped(f"{name:<12}{text}", 12)]


def _given(study: Study) -> list[tuple[str, str]]:
    record, view, x = study.record, study.seen, study.record.values
    how = f"{len(x)} samples; time is counted in samples"
    if record.unit == "s":
        how = f"{len(x)} samples, one every {record.step:.6g} s, {(len(x) - 1) * record.step:.6g} s in all"
    points = f"{len(view.points)} points"
    if view.kind != SAMPLES:
        points += f", {view.period:.6g} {record.unit} apart" + " on average" * (view.kind == MAXIMA)
    noise = f"white noise at most {view.noise / np.ptp(x):.1g} of it"
    span = f"{x.min():.6g} to {x.max():.6g}, {noise}"
    return [("record", how), ("range", span), ("seen", f"{SEEN[view.kind]}: {points}")]


def _found(study: Study) -> list[tuple[str, str]]:
    unit, per = ("s", "s") if study.record.unit == "s" else ("samples", "sample")
    lines = []
    for peak in study.lines[:3]:
        turn = 2.0 * np.pi / peak.angular_frequency_radps
        lines.append(
            f"{peak.angular_frequency_radps:.4g} rad/{per} (every {turn:.4g} {unit}) with {peak.amplitude:.3g}"
        )
    highest = "; ".join(lines) or "no line stands out"
    rows = [("spectrum", f"eq. (31), later half, highest lines: {highest}")]
    for name, exponent in (("Wolf", study.wolf), ("Rosenstein", study.rosenstein), ("Kantz", study.kantz)):
        rows.append((name, f"exponent {_exponent(exponent, study, per)}"))
    rows.append(("0-1 test", f"K = {number(study.zero_one.value)}: {study.zero_one.reason}"))
    value, error = study.dimension
    if study.embedding is None:
        return [*rows, ("dimension", f"none: {study.wolf.reason}")]
    m = study.embedding.dimension
    text = f"{number(value, error)} (correlation dimension, the same in {m}, {m + 1} and {m + 2} delays)"
    if not np.isfinite(value):
        each = ", ".join(number(one.value, one.error) for one in study.dimensions)
        text = f"none: it does not settle in {m}, {m + 1} and {m + 2} delays ({each})"
    return [*rows, ("dimension", text)]


def _exponent(exponent: Exponent, study: Study, per: str) -> str:
    if not exponent.found:
        return f"none: {exponent.reason}"
    bits = exponent.in_bits_per_period(study.seen.period)
    text = f"{number(exponent.value, exponent.error)} nats/{per}"
    return f"{text} = {number(bits.value, bits.error)} bits per {CYCLE[study.seen.kind][0]}"


def _in_cycles(study: Study, text: str) -> str:
    """Verdicts count forcing periods; a section at maxima or of samples has other cycles."""
    if study.seen.kind == STROBED:
        return text
    one, many = CYCLE[study.seen.kind]
    text = text.replace("bits per period", f"bits per {one}")
    text = re.sub(r"(forcing )?period(s|\(s\))", many, text)
    return re.sub(rf"\b1 {many}", f"1 {one}", text)


def _verdict(study: Study) -> list[tuple[str, str]]:
    word, count = study.verdict.regime, study.verdict.period
    meaning = MEANING.get(word)
    if count is not None:
        cycle = CYCLE[study.seen.kind][count > 1]
        meaning = f"the motion repeats itself after {count} {'forcing ' * (study.seen.kind == STROBED)}{cycle}"
    return [("VERDICT", f"{word}: {meaning}"), ("because", _in_cycles(study, study.verdict.reason))]


def _evidence(study: Study) -> list[str]:
    rows = ["evidence (passed or not, what was found, the value and what it was compared with)"]
    for item in study.verdict.evidence:
        compared = "" if not np.isfinite(item.threshold) else f" against {item.threshold:.4g}"
        value = "" if not np.isfinite(item.value) else f" [{item.value:.4g}{compared}]"
        rows += _wrapped(f"  {MARK[item.passed]:<4}{item.name}: {_in_cycles(study, item.sentence)}{value}", 6)
    return rows


def _notes(study: Study) -> list[str]:
    """What the reader could do for a better answer."""
    notes, view, record = [], study.seen, study.record
    noise, undecided = view.noise / np.ptp(record.values), study.verdict.regime == "undecided"
    if record.unit != "s":
        notes.append("time is counted in samples: --time COLUMN or --step SECONDS puts it in seconds")
    if undecided and len(view.points) < 200:
        needed = "chaos can be shown with 200 points or more on the section, any regime with 40"
        notes.append(f"{needed}; here are {len(view.points)}")
    if undecided and view.kind != SAMPLES and 1e-4 < noise < 0.05:
        asked = f"the noise is {noise:.1g} of the range, and repetition was asked within {study.tolerance:.1g} of it"
        notes.append(f"{asked}: --tolerance {8 * noise:.1g} asks whether the motion repeats within its noise")
    if view.kind == MAXIMA:
        notes.append("of a motion that is forced with a known period, --period sees more: the section once per period")
    if study.used < len(record.values):
        notes.append(f"exponents and dimension are those of the last {study.used} samples")
    return notes
