"""The line of stderr that shows what a command is doing, how far it is, and since when; tqdm draws it.

    with stage("runs from rest", 120, "runs", count=lambda: 40):
        ...

Stages can be nested. The line shows the titles of all open stages, the count of the innermost stage that counts, and
the time since the outermost stage began. On a terminal a thread draws the line again and again, so that it moves while
this process waits for workers. In a file or a pipe a new line is written at most once in LINE_S seconds, and at the
end of a long stage that counts. The line does not estimate the time left, because runs and machines differ too much.

A worker writes its progress into a small file (`reporter`), and the main process reads the files of all workers
(`reports`). This works for processes, threads and dask. If a worker does not see the folder of these files, its
progress is not known until it ends.
"""

import contextlib
import inspect
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

DRAW_S = 0.25  # between two drawings on a terminal
FIRST_S, LINE_S = 5.0, 10.0  # before the first line of a file, and between two lines
REPORT_S = 0.3  # between two reports of a worker
BAR = "{desc}, {elapsed} since the start |{bar:20}|"


@dataclass(eq=False)
class Stage:
    """A piece of work that takes a while.

    title: the work in words. total: number of things to do, 0 if it is not known. unit: their name in the plural.
    count() -> how many of them are done. detail() -> further words on the progress.
    """

    title: str
    total: int = 0
    unit: str = ""
    count: Callable[[], float] = lambda: 0
    detail: Callable[[], str] = str
    began: float = field(default_factory=time.monotonic)

    def words(self) -> str:
        """Title, count and detail in one line."""
        counted = f"{self.count():.0f} of {self.total:.0f} {self.unit}" if self.total else ""
        return ", ".join(filter(None, (self.title, counted, self.detail())))


_open: list[Stage] = []
_lock = threading.RLock()
_next_line = {"s": 0.0}  # when the next line of a file is due
_bars: list = []  # the bar that is drawn on a terminal


@contextlib.contextmanager
def stage(title: str, *counted: object, **options: object) -> Iterator[None]:
    """Show a stage while the block lasts; title, counted and options are the fields of `Stage`."""
    entered = Stage(title, *counted, **options)
    with _lock:
        if not _open:
            _next_line["s"] = entered.began + FIRST_S
        _open.append(entered)
    _start_drawing()
    try:
        yield
    finally:
        with _lock:
            if entered.total and not _terminal() and time.monotonic() - entered.began > LINE_S:
                with contextlib.suppress(OSError):  # the folder of reports is gone
                    _write(f"{_text()}, ended after {_clock(entered.began)}\n")
            _open.remove(entered)
            if not _open:
                _close_bar()


def in_parts(parts: Sequence[Callable]) -> None:
    """Do the parts of a piece of work one after the other, each shown as "part 2 of 8"."""
    for number, part in enumerate(parts, 1):
        with stage(f"part {number} of {len(parts)}"):
            part()


def print_line(text: str) -> None:
    """Write a separate line to stderr without breaking the line of the stages."""
    with _lock:
        _close_bar()
        _write(f"{text}\n")


@cache
def _start_drawing() -> None:
    threading.Thread(target=_keep_drawing, daemon=True).start()


def _keep_drawing() -> None:
    while True:
        time.sleep(DRAW_S)
        with _lock, contextlib.suppress(OSError, ValueError):  # stderr is closed
            if _open and _terminal():
                _draw()
            elif _open and time.monotonic() >= _next_line["s"]:
                _write(f"{_text()}, {_clock(_open[0].began)} since the start\n")
                _next_line["s"] = time.monotonic() + LINE_S


def _draw() -> None:
    from tqdm import tqdm

    if not _bars:
        _bars.append(tqdm(desc=_text(), file=sys.stderr, leave=False, dynamic_ncols=True, bar_format=BAR))
    (bar,) = _bars
    counting = _counting()
    bar.start_t = time.time() - (time.monotonic() - _open[0].began)
    bar.total, bar.n = counting.total or None, min(counting.count(), counting.total)
    bar.set_description_str(_text())


def _close_bar() -> None:
    for bar in _bars:
        with contextlib.suppress(OSError, ValueError):
            bar.close()
    _bars.clear()


def _counting() -> Stage:
    """The innermost stage that counts; if no stage counts, the innermost stage."""
    for entered in reversed(_open):
        if entered.total:
            return entered
    return _open[-1]


def _text() -> str:
    counting = _counting()
    titles = [entered.title for entered in _open]
    titles[_open.index(counting)] = counting.words()
    return ": ".join(titles)


def _terminal() -> bool:
    with contextlib.suppress(OSError, ValueError, AttributeError):
        return sys.stderr.isatty()
    return False


def _write(text: str) -> None:
    with contextlib.suppress(OSError, ValueError, AttributeError):
        sys.stderr.write(text)
        sys.stderr.flush()


def _clock(began: float) -> str:
    """The time since `began` (of time.monotonic), as 1:23 or 1:02:03."""
    from tqdm import tqdm

    return tqdm.format_interval(time.monotonic() - began).removeprefix("0")


def reporter(folder: Path | None, task: str) -> Callable:
    """A function report(*numbers) by which a worker tells the progress of a task; without a folder it does nothing.

    Numbers that follow within REPORT_S are left out, unless they are the last=True ones.
    """
    last_s = -REPORT_S

    def report(*numbers, last=False):
        nonlocal last_s
        now = time.monotonic()
        if folder is not None and (last or now - last_s >= REPORT_S):
            last_s = now
            with contextlib.suppress(OSError):  # another machine, or a campaign that has ended
                draft = folder / f"{task}.{os.getpid()}"
                draft.write_text(" ".join(f"{number:g}" for number in numbers), encoding="ascii")
                draft.rename(folder / task)

    return report


def reports(folder: Path) -> dict[str, list]:
    """The last numbers that each `reporter` of a folder has written, by task."""
    numbers = {}
    for path in folder.iterdir():
        if not path.suffix:  # a file with a suffix is still being written
            with contextlib.suppress(OSError, ValueError):
                numbers[path.name] = list(map(float, path.read_text(encoding="ascii").split()))
    return numbers


def with_progress(simulate: Callable, report: Callable) -> dict[str, Callable]:
    """{"progress": report} if the function `simulate` has an argument progress, as engine.simulate has; else {}."""
    if "progress" in inspect.signature(simulate).parameters:
        return {"progress": report}
    return {}
