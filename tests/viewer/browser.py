"""A headless Chromium, driven over its pipe: what a page does, says and asks for.

Needs Debian's chromium alone. Two file descriptors carry JSON with a zero byte behind each message,
as `--remote-debugging-pipe` asks for."""

import base64
import contextlib
import json
import os
import select
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib

CHROMIUM = shutil.which(os.environ.get("CHROMIUM", "chromium"))


class Browser:
    def __init__(self, width=900, height=640):
        self.profile = tempfile.mkdtemp(prefix="treeform-browser-")
        (ours_in, its_out), (its_in, ours_out) = os.pipe(), os.pipe()

        def arrange():  # the browser has its ends as 3 and 4
            os.dup2(its_in, 103), os.dup2(its_out, 104)
            os.dup2(103, 3), os.dup2(104, 4)

        self.process = subprocess.Popen(
            [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
             "--use-gl=angle",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
             "--force-device-scale-factor=1", "--force-prefers-reduced-motion", "--no-first-run",
             f"--window-size={width},{height}", f"--user-data-dir={self.profile}",
             "--remote-debugging-pipe", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            preexec_fn=arrange, close_fds=False, start_new_session=True)
        for end in (its_in, its_out):
            os.close(end)
        self.reader, self.writer = ours_in, ours_out
        self.buffer, self.count, self.events, self.session = b"", 0, [], None
        targets = self.call("Target.getTargets")["targetInfos"]
        page = next(t["targetId"] for t in targets if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(10)
        except Exception:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
        os.close(self.reader), os.close(self.writer)
        shutil.rmtree(self.profile, ignore_errors=True)

    def receive(self, seconds):
        end = time.monotonic() + seconds
        while b"\0" not in self.buffer:
            if not select.select([self.reader], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            data = os.read(self.reader, 1 << 20)
            if not data:
                raise EOFError("the browser has ended")
            self.buffer += data
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.writer, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive(300)
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            if "method" in answer:
                self.events.append((answer["method"], answer.get("params", {})))

    def run(self, script):
        """The value of an expression in the page, awaited."""
        done = self.call("Runtime.evaluate", expression=script, returnByValue=True,
                         awaitPromise=True)
        if "exceptionDetails" in done:
            details = done["exceptionDetails"]
            raise RuntimeError(details.get("exception", {}).get("description", details["text"]))
        return done["result"].get("value")

    def open(self, path, fragment=""):
        self.events.clear()
        self.call("Page.navigate", url="file://" + os.path.abspath(path) + fragment)
        end = time.monotonic() + 300
        while not any(method == "Page.loadEventFired" for method, _ in self.events):
            if time.monotonic() > end:
                raise TimeoutError(path + " does not load")
            self.run("1")
        self.settle()

    @contextlib.contextmanager
    def in_frame(self):
        """What is run meanwhile is run in the page's frame, which has an origin of its own."""
        outer, self.session = self.session, None
        end = time.monotonic() + 60
        while True:
            frames = [t for t in self.call("Target.getTargets")["targetInfos"]
                      if t["type"] == "iframe"]
            if frames:
                break
            if time.monotonic() > end:
                raise TimeoutError("no frame")
        self.session = self.call("Target.attachToTarget", targetId=frames[0]["targetId"],
                                 flatten=True)["sessionId"]
        try:
            yield
        finally:
            self.session = outer

    def settle(self):
        """Waits until what was asked for is drawn."""
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => "
                 "requestAnimationFrame(done))))")

    def complaints(self):
        """What the console, the log and the page's scripts have said, and what it asked for."""
        said = []
        for method, event in self.events:
            if method == "Runtime.consoleAPICalled":
                said.append(" ".join(str(a.get("value", a)) for a in event["args"]))
            elif method == "Runtime.exceptionThrown":
                said.append(json.dumps(event["exceptionDetails"]))
            elif method == "Log.entryAdded":
                said.append(event["entry"]["text"])
            elif method == "Network.requestWillBeSent" and event.get("type") != "Document":
                said.append("asked for " + event["request"]["url"])
        return said

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1,
                      clickCount=1)
        self.settle()

    def drag(self, x, y, dx, dy, modifiers=0):
        at = {"button": "left", "buttons": 1, "modifiers": modifiers}
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, clickCount=1, **at)
        for share in (0.5, 1):
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + dx * share, y=y
                      + dy * share,
                      **at)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=x + dx, y=y + dy, **at)
        self.settle()

    def wheel(self, x, y, by):
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=by)
        self.settle()

    def press(self, key):
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)
        self.settle()

    def screenshot(self, scale=1.0):
        """(width, height, rows of RGB bytes, the PNG) of the window, made smaller."""
        w, h = self.run("[innerWidth, innerHeight]")
        shot = self.call("Page.captureScreenshot", format="png",
                         clip={"x": 0, "y": 0, "width": w, "height": h, "scale": scale})
        data = base64.b64decode(shot["data"])
        return (*read_png(data), data)


def read_png(data):
    """(width, height, rows) of an RGB or RGBA PNG of 8 bits, alpha left out."""
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", body[:10])
            assert bits == 8 and color in (2, 6), "not RGB or RGBA of 8 bits"
            step = 3 if color == 2 else 4
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    raw, stride, rows, above = zlib.decompress(packed), width * step, [], bytearray(width * step)
    for y in range(height):
        sort = raw[y * (stride + 1)]
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - step] if i >= step else 0
            corner = above[i - step] if i >= step else 0
            if sort == 1:
                line[i] = (line[i] + left) & 255
            elif sort == 2:
                line[i] = (line[i] + above[i]) & 255
            elif sort == 3:
                line[i] = (line[i] + (left + above[i]) // 2) & 255
            elif sort == 4:
                guess = left + above[i] - corner
                near = min((left, above[i], corner), key=lambda v: abs(guess - v))
                line[i] = (line[i] + near) & 255
        above = line
        rows.append(bytes(b for i in range(0, stride, step) for b in line[i:i + 3]))
    return width, height, rows
