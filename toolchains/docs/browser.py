"""A headless Chromium, steered over its DevTools protocol through a pair of pipes: no driver and no port is needed."""

from __future__ import annotations

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

PROGRAMS = ("chromium-headless-shell", "chromium")


def find() -> str | None:
    return next((path for name in PROGRAMS if (path := shutil.which(name))), None)


class Browser:
    """One page. `with Browser(program) as browser: ...`"""

    def __init__(self, program: str, limit_s: float = 60.0) -> None:
        self._limit_s, self._number = limit_s, 0
        self._folder = tempfile.TemporaryDirectory(prefix="docs-browser-", ignore_cleanup_errors=True)
        to_browser, self._write_end = os.pipe()
        self._read_end, from_browser = os.pipe()
        words = [program, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run"]
        words += [f"--user-data-dir={self._folder.name}", "--remote-debugging-pipe"]
        # Chromium reads from descriptor 3 and writes to 4, whatever their numbers are here.
        script = f'exec "$@" 3<&{to_browser} 4>&{from_browser}'
        self._process = subprocess.Popen(
            ["bash", "-c", script, "bash", *words, "about:blank"],
            pass_fds=[to_browser, from_browser],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        os.close(to_browser)
        os.close(from_browser)
        self._left = b""
        self._session = ""
        targets = self._call("Target.getTargets")["targetInfos"]
        page = next(target["targetId"] for target in targets if target["type"] == "page")
        self._session = self._call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.wait()
        os.close(self._write_end)
        os.close(self._read_end)
        self._folder.cleanup()

    def open(self, url: str) -> None:
        self._call("Page.navigate", url=url)
        self.wait_for("document.readyState === 'complete'")

    def evaluate(self, script: str) -> Any:
        """The value of an expression in the page."""
        answer = self._call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait_for(self, script: str) -> None:
        """Until an expression in the page is true."""
        begin = time.monotonic()
        while not self.evaluate(script):
            if time.monotonic() - begin > self._limit_s:
                raise TimeoutError(f"not within {self._limit_s:.0f} s: {script}")
            time.sleep(0.02)

    def show_as(self, width: int, height: int, scheme: str) -> None:
        """`scheme`: light or dark, as the reader's system prefers."""
        self._call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self._call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def picture(self, file: Path, clip: dict[str, float] | None = None) -> None:
        """Of what the screen shows, or of a part of the page: x, y, width, height, scale."""
        part = {"clip": clip, "captureBeyondViewport": True} if clip else {}
        file.write_bytes(base64.b64decode(self._call("Page.captureScreenshot", format="png", **part)["data"]))

    def _call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write_end, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._left:
            some = os.read(self._read_end, 1 << 16)
            if not some:
                raise RuntimeError("the browser has ended")
            self._left += some
        text, _, self._left = self._left.partition(b"\0")
        return json.loads(text)
