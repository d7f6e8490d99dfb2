"""A Study as a page of plain text: what was given, what was found with its error, the verdict, and why."""

import re
import textwrap

import numpy as np

from analysis.any_series.sections import MAXIMA, SAMPLES, STROBED

WIDTH = 100
MARK = {True: "yes", False: "no", None: "--"}
CYCLE = {STROBED: "period", SAMPLES: "sample", MAXIMA: "maximum"}
SEEN = {
    STROBED: "once per forcing period, at four phases of it",
    SAMPLES: "sample by sample, as a map",
    MAXIMA: "at its maxima, as no --period was given",
}
MEANING = {
    "period": "the motion repeats itself",
    "quasi-periodic": "two or more rhythms that never meet; no sensitivity to the start",
    "chaotic": "deterministic, and neighbouring states part exponentially",
    "transient": "the motion has not settled: cut its beginning, or record longer",
    "undecided": "neither regular nor shown to be chaotic: noise, too short a record, or both at once",
}


def page(study):
    """The text, without a last newline."""
    lines = [*_given(study), "", *_found(study), "", *_verdict(study), "", *_evidence(study)]
    notes = _notes(study)
    return "\n".join([*lines, "", *notes] if notes else lines)


def number(value, error=None):
    """A value with the digits that its error leaves, or four."""
    if value is None or not np.isfinite(value):
        return "none"
    if error is None or not np.isfinite(error) or error <= 0.0:
        return f"{value:.4g}"
    digits = int(np.clip(1 - np.floor(np.log10(error)), 0, 12))
    return f"{value:.{digits}f} +- {error:.{digits}f}"


def _row(name, text):
    head = f"{name:<12}"
    return textwrap.wrap(head + text, WIDTH, subsequent_indent=" " * 12, break_long_words=False) or [head]


def _given(study):
    record, view = study.record, study.seen
    unit = "s" if record.unit == "s" else "samples"
    length = (len(record.values) - 1) * record.step
    how = f"{len(record.values)} samples, one every {record.step:.6g} s, {length:.6g} s in all"
    if record.unit != "s":
        how = f"{len(record.values)} samples; time is counted in samples"
    between = f"{len(view.points)} points"
    if view.kind != SAMPLES:
        between += f", {view.period:.6g} {unit} apart" + " on average" * (view.kind == MAXIMA)
    x, share = record.values, view.noise / np.ptp(record.values)
    return [
        f"{record.path}, column {record.column}",
        *_row("record", how),
        *_row("range", f"{x.min():.6g} to {x.max():.6g}, white noise at most {share:.1g} of it"),
        *_row("seen", f"{SEEN[view.kind]}: {between}"),
    ]


def _found(study):
    per, unit = ("s", "s") if study.record.unit == "s" else ("sample", "samples")
    lines = []
    for peak in study.lines[:3]:
        turn = 2.0 * np.pi / peak.angular_frequency_radps
        place = f"{peak.angular_frequency_radps:.4g} rad/{per} (every {turn:.4g} {unit})"
        lines.append(f"{place} with {peak.amplitude:.3g}")
    text = "; ".join(lines) or "no line stands out"
    rows = _row("spectrum", f"eq. (31), later half, highest lines: {text}")
    for name, exponent in (("Wolf", study.wolf), ("Rosenstein", study.rosenstein), ("Kantz", study.kantz)):
        if exponent.found:
            bits = exponent.in_bits_per_period(study.seen.period)
            cycle = CYCLE[study.seen.kind]
            text = f"{number(exponent.value, exponent.error)} nats/{per}"
            text += f" = {number(bits.value, bits.error)} bits per {cycle}"
        else:
            text = f"none: {exponent.reason}"
        rows += _row(name, f"exponent {text}")
    rows += _row("0-1 test", f"K = {number(study.zero_one.value)}: {study.zero_one.reason}")
    if study.embedding is None:
        return rows + _row("dimension", f"none: {study.wolf.reason}")
    value, error = study.dimension
    m = study.embedding.dimension
    text = f"{number(value, error)} (correlation dimension, the same in {m}, {m + 1} and {m + 2} delays)"
    if not np.isfinite(value):
        each = ", ".join(number(one.value, one.error) for one in study.dimensions)
        text = f"none: it does not settle in {m}, {m + 1} and {m + 2} delays ({each})"
    return rows + _row("dimension", text)


def _in_cycles(study, text):
    """Verdicts count forcing periods; a section at maxima or of samples has other cycles."""
    if study.seen.kind == STROBED:
        return text
    cycle = CYCLE[study.seen.kind]
    plural = "maxima" if cycle == "maximum" else f"{cycle}s"
    for words in ("forcing period(s)", "forcing periods", "periods", "period(s)"):
        text = text.replace(words, plural)
    text = re.sub(rf"\b1 {plural}", f"1 {cycle}", text)
    return text.replace("bits per period", f"bits per {cycle}")


def _verdict(study):
    word = study.verdict.regime
    if study.verdict.period is not None:
        word_for = {STROBED: "forcing period", SAMPLES: "sample", MAXIMA: "maximum"}[study.seen.kind]
        plural = "maxima" if study.seen.kind == MAXIMA else f"{word_for}s"
        count = study.verdict.period
        meaning = f"the motion repeats itself after {count} {word_for if count == 1 else plural}"
    else:
        meaning = MEANING[word]
    return _row("VERDICT", f"{word}: {meaning}") + _row("because", _in_cycles(study, study.verdict.reason))


def _evidence(study):
    rows = ["evidence (passed or not, what was found, the value and what it was compared with)"]
    for item in study.verdict.evidence:
        compared = "" if not np.isfinite(item.threshold) else f" against {item.threshold:.4g}"
        value = "" if not np.isfinite(item.value) else f" [{item.value:.4g}{compared}]"
        text = f"{item.name}: {_in_cycles(study, item.sentence)}{value}"
        rows += textwrap.wrap(f"  {MARK[item.passed]:<4}{text}", WIDTH, subsequent_indent=" " * 6)
    return rows


def _notes(study):
    """What the reader could do for a better answer."""
    notes, view, record = [], study.seen, study.record
    noise = view.noise / np.ptp(record.values)
    if record.unit != "s":
        notes.append("time is counted in samples: --time COLUMN or --step SECONDS puts it in seconds")
    if study.verdict.regime == "undecided" and len(view.points) < 200:
        needed = "chaos can be shown with 200 points or more on the section, any regime with 40"
        notes.append(f"{needed}; here are {len(view.points)}")
    if study.verdict.regime == "undecided" and view.kind != SAMPLES and 1e-4 < noise < 0.05:
        asked = f"the noise is {noise:.1g} of the range, and repetition was asked within {study.tolerance:.1g} of it"
        notes.append(f"{asked}: --tolerance {8 * noise:.1g} asks whether the motion repeats within its noise")
    if view.kind == MAXIMA:
        notes.append("of a motion that is forced with a known period, --period sees more: the section once per period")
    if study.used < len(record.values):
        notes.append(f"exponents and dimension are those of the last {study.used} samples")
    return [line for note in notes for line in textwrap.wrap(f"note: {note}", WIDTH, subsequent_indent="      ")]
