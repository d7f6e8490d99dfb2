"""What a command is doing, how far it is and how long it will take: one line of stderr that moves.

    with stage("runs", 14_700, "wave periods", far=lambda: 350.0):
        ...

A thread of its own keeps the line up to date, so that it moves while this process waits for workers or compiles. On a
terminal one line is drawn again and again; elsewhere (a file, a pipe) a stage that lasts says a line now and then.
Stages nest: the names of all are shown, and how far the innermost one is that counts something.

A worker says how far its task is by a small file in a folder that the main process looks into (`teller`, `shares`).
That does for processes, threads and dask alike; a worker that does not see the folder says nothing.
"""

import contextlib
import inspect
import os
import shutil
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

DRAWN_S = 0.25  # between two drawings on a terminal
FIRST_S, SAID_S = 1.5, 8.0  # to the first line elsewhere, and between two lines
ASKED_S = 3.0  # of a stage before its time left is told
TOLD_S = 0.3  # between two words of a worker
BAR = 20  # characters
RECENT = 0.7  # share of the time so far from which the speed is taken: runs that come later may be slower


@dataclass
class Stage:
    """A piece of work that takes a while. far() -> how much of `total` is done; without a total only the time is told.

    then(seconds that it takes in all) -> seconds of what follows it, to the end of the stage around it; None: unknown.
    How many kernels are compiled meanwhile, by whichever process, is said too.
    """

    what: str
    total: float = 0.0
    unit: str = ""
    far: Callable[[], float] | None = None
    then: Callable[[float], float] | None = None
    began: float = field(default_factory=time.monotonic)
    seen: deque = field(default_factory=lambda: deque([(0.0, 0.0)], maxlen=4096))  # (seconds, done)

    def look(self) -> tuple[float, float]:
        """Seconds since it began, and how much is done by then: kept for `left_s`."""
        now = time.monotonic() - self.began
        self.seen.append((now, min(self.far(), self.total) if self.far is not None else 0.0))
        return self.seen[-1]

    def left_s(self) -> float | None:
        """Seconds to its end at the speed of the last RECENT of its time; None where that is not known yet."""
        now, done = self.seen[-1]
        since, before = next(one for one in self.seen if one[0] >= (1.0 - RECENT) * now)
        known = now >= ASKED_S and before < done < self.total
        return (self.total - done) * (now - since) / (done - before) if known else None

    def told(self, around: list["Stage"]) -> str:
        """The line behind its name: how far, how long so far, how long still; what it counts, what is compiled.

        around: the stages that it lies in, the innermost first.
        """
        now, done = self.look()
        parts = [_clock(now), *([f"{kernels} kernels compiled"] if (kernels := self._kernels()) else [])]
        if self.total:
            bar = f"[{'#' * int(BAR * done / self.total):-<{BAR}}] {done / self.total:3.0%}"
            parts = [bar, *parts, self._left([self, *around]), f"of {self.total:,.0f} {self.unit}"]
        return ", ".join(parts)

    def _kernels(self) -> int:
        """How many any process has compiled since it began."""
        made_since = getattr(sys.modules.get("machine_code.store"), "made_since", None)  # not while it is imported
        return made_since(time.time() - self.seen[-1][0]) if made_since is not None else 0

    def _left(self, stages: list["Stage"]) -> str:
        left = self.left_s()
        if left is None:
            return "time left not known"
        if any(one.then is None for one in stages):
            return f"about {_clock(left)} left of this"
        for one in stages:  # what is around it does not end before it
            now = one.look()[0]
            left = max(left, one.left_s() or 0.0)
            left += one.then(now + left)
        return f"about {_clock(left)} left"

    def ended(self) -> str:
        """The last line; "" of a stage that was short or counted nothing."""
        now = self.look()[0]
        return f"{_named()}: ended, {_clock(now)}\n" if self.far is not None and now > ASKED_S else ""


_open: list[Stage] = []
_lock = threading.RLock()
_next = {"s": 0.0}  # when the next line of a file is due


@contextlib.contextmanager
def stage(what: str, *counted: object, **more: object) -> Iterator[Stage]:
    """Show a `Stage` of these fields for as long as the `with` lasts."""
    one = Stage(what, *counted, **more)
    with _lock:
        if not _open:
            _next["s"] = one.began + FIRST_S
        _open.append(one)
    _drawn()
    try:
        yield one
    finally:
        with _lock:
            _write(one.ended())
            _open.remove(one)


def counting(what: str, seconds: float) -> contextlib.AbstractContextManager[Stage]:
    """The last `stage` within another one, whose time is known beforehand."""
    began = time.monotonic()
    return stage(what, seconds, "s", lambda: time.monotonic() - began, last)


def last(_seconds: float) -> float:
    """`Stage.then` of a stage that nothing follows."""
    return 0.0


def tell(text: str) -> None:
    """A line of its own on stderr, while a stage may be shown there."""
    with _lock:
        _write(f"{text}\n")


@cache
def _drawn() -> None:
    threading.Thread(target=_keep_drawing, daemon=True).start()


def _keep_drawing() -> None:
    while True:
        with _lock:
            if _open:
                _draw()
        time.sleep(DRAWN_S)


def _draw() -> None:
    shown = next((i for i in reversed(range(len(_open))) if _open[i].far), len(_open) - 1)
    text = _open[shown].told(_open[:shown][::-1])
    if _terminal():
        names, width = [one.what for one in _open], shutil.get_terminal_size().columns - 1
        while len(names) > 1 and len(": ".join([*names, text])) > width:
            names.pop(0)
        _write(": ".join([*names, text])[:width])
    elif time.monotonic() >= _next["s"]:
        _write(f"{_named()}: {text}\n")
        _next["s"] = time.monotonic() + SAID_S


def _terminal() -> bool:
    with contextlib.suppress(OSError, ValueError, AttributeError):
        return sys.stderr.isatty()
    return False


def _write(text: str) -> None:
    """In place of the line of a terminal, behind the lines of a file."""
    with contextlib.suppress(OSError, ValueError, AttributeError):  # nobody listens any more
        sys.stderr.write(("\r\x1b[K" if _terminal() else "") + text)
        sys.stderr.flush()


def _named() -> str:
    return ": ".join(one.what for one in _open)


def _clock(seconds: float) -> str:
    """ "0:07", "1:02:03"."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def teller(folder: Path | None, name: str) -> Callable[[float], None]:
    """For a worker: a function of the share of its task that is done; folder None: nobody asks."""
    last_s = -TOLD_S

    def told(fraction: float) -> None:
        nonlocal last_s
        now = time.monotonic()
        if folder is not None and now - last_s >= TOLD_S:
            last_s = now
            with contextlib.suppress(OSError):  # another machine, or a campaign that has ended
                begun = folder / f"{name}.{os.getpid()}"
                begun.write_text(f"{fraction:.6f}", encoding="ascii")
                begun.rename(folder / name)

    return told


@contextlib.contextmanager
def ticking(told: Callable[[float], None], seconds: float) -> Iterator[None]:
    """Tell, while the `with` lasts, how much of so many seconds of processor time this process has taken."""
    began, ended = time.process_time(), threading.Event()

    def tick() -> None:
        while not ended.wait(TOLD_S):
            told(min((time.process_time() - began) / seconds, 1.0))

    threading.Thread(target=tick, daemon=True).start()
    try:
        yield
    finally:
        ended.set()


def shares(folder: Path) -> dict[str, float]:
    """The last word of every `teller` of a folder, by name."""
    found = {}
    for path in (path for path in folder.iterdir() if not path.suffix):  # of a file that is being written
        with contextlib.suppress(OSError, ValueError):
            found[path.name] = float(path.read_text(encoding="ascii"))
    return found


def in_time(done: float, runs: int, lanes: int) -> float:
    """Share of the time of a task whose runs go in so many lanes, from the share of the runs that is done.

    Runs that cost alike end together, round after round; the last round takes as long where it has fewer runs.
    """
    rounds, rest = divmod(runs, lanes)
    full = min(done * runs, rounds * lanes)
    last = (done * runs - full) / rest if rest else 0.0
    return (full / lanes + last) / (rounds + bool(rest))


def heard(function: Callable, told: Callable[[float], None]) -> dict[str, Callable]:
    """{"progress": told} for a function that takes it, as engine.simulate does."""
    return {"progress": told} if "progress" in inspect.signature(function).parameters else {}
