"""A headless Chromium driven over the DevTools protocol through a pair of pipes: no port, no package, no network.

`--remote-debugging-pipe`: the browser reads commands from file descriptor 3 and writes answers to 4, one JSON object
each, ended by a zero byte (Chrome DevTools Protocol, "Protocol Basics").
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
OPTIONS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--no-first-run",
    "--disable-extensions",
    "--disable-background-networking",
    "--remote-debugging-pipe",
)
DEADLINE_S = 60.0


def installed() -> str | None:
    """The command of a Chromium on this machine, None without one."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Chromium:
    """One browser with one tab; use it in a `with` block, which ends both."""

    def __init__(self, width: int = 1200, height: int = 900, dark: bool = False, scripts: bool = True,
                 still: bool = False):  # fmt: skip
        self._size, self._scripts = (width, height), scripts
        self._wishes = {
            "prefers-color-scheme": "dark" if dark else "light",
            "prefers-reduced-motion": "reduce" if still else "no-preference",
        }
        self._number, self._rest, self._events = 0, b"", []

    def __enter__(self):
        self._home = tempfile.TemporaryDirectory(prefix="chromium-", ignore_cleanup_errors=True)
        theirs, self._out = os.pipe()
        self._in, answers = os.pipe()

        def hand_over():
            # copies out of the way first: either end may itself be number 3 or 4
            high = os.dup(theirs), os.dup(answers)
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        command = [installed(), *OPTIONS, f"--user-data-dir={self._home.name}", "about:blank"]
        quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self._process = subprocess.Popen(command, close_fds=False, preexec_fn=hand_over, **quiet)
        os.close(theirs)
        os.close(answers)
        target = self.call("Target.createTarget", url="about:blank", top=True)["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True, top=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network"):
            self.call(f"{domain}.enable")
        width, height = self._size
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        wishes = [{"name": name, "value": wish} for name, wish in self._wishes.items()]
        self.call("Emulation.setEmulatedMedia", features=wishes)
        self.call("Emulation.setScriptExecutionDisabled", value=not self._scripts)
        return self

    def __exit__(self, *_):
        try:
            self.call("Browser.close", top=True)
            self._process.wait(10)
        except (OSError, RuntimeError, TimeoutError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._out)
        os.close(self._in)
        self._home.cleanup()

    def call(self, method: str, top: bool = False, **parameters) -> dict:
        """One command, its result. top: to the browser itself. RuntimeError for a refusal, TimeoutError for silence."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        message |= {} if top else {"sessionId": self._session}
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._out, data) :]
        number = self._number
        answer = self._until(lambda one: one.get("id") == number)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def open(self, path: Path) -> None:
        """Load a file and wait until it is complete; RuntimeError for one that cannot be loaded."""
        self._events.clear()
        reply = self.call("Page.navigate", url=path.absolute().as_uri())
        if "errorText" in reply:
            raise RuntimeError(f"{path}: {reply['errorText']}")
        self._until(lambda one: one.get("method") == "Page.loadEventFired", self._events)

    def value(self, expression: str):
        """What a JavaScript expression gives (a promise: what it comes to); RuntimeError where it throws."""
        found = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise RuntimeError(found["exceptionDetails"].get("exception", {}).get("description", "the script threw"))
        return found["result"].get("value")

    def mouse(self, kind: str, x: float, y: float, **more) -> None:
        """One mouse event at a place of the window: mousePressed, mouseReleased, mouseMoved or mouseWheel."""
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x: float, y: float) -> None:
        """A click of the left button."""
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", buttons=1, clickCount=1)

    def press(self, key: str, text: str = "") -> None:
        """A key pressed and released; text: what it types."""
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def picture(self, whole: bool = False) -> bytes:
        """A PNG of what is seen, or of the whole page."""
        return base64.b64decode(self.call("Page.captureScreenshot", captureBeyondViewport=whole)["data"])

    def asked_for(self) -> list[str]:
        """Addresses of everything requested since `open` but files on disk and data inside the page."""
        urls = (one["params"]["request"]["url"] for one in self._events if one["method"] == "Network.requestWillBeSent")
        return [url for url in urls if not url.startswith(("file:", "data:"))]

    def _until(self, wanted, seen=()) -> dict:
        """The first message that is wanted, of those seen already or yet to come; events are kept."""
        for message in seen:
            if wanted(message):
                return message
        end = time.monotonic() + DEADLINE_S
        while True:
            while b"\0" in self._rest:
                line, _, self._rest = self._rest.partition(b"\0")
                message = json.loads(line)
                if "method" in message:
                    self._events.append(message)
                if wanted(message):
                    return message
            if not select.select([self._in], [], [], max(0.0, end - time.monotonic()))[0]:
                raise TimeoutError("Chromium does not answer")
            self._rest += os.read(self._in, 1 << 20)
