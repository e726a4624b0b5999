#!/usr/bin/python3
"""check_browser.py [--except FOLDER] [--pictures FOLDER] PATH...: opens HTML files, and those in folders, in headless Chromium at two
widths of a window, and exits with 1 where a page

    writes an error to the console, or raises an exception,
    asks the network for something,
    loads a file or shows a picture that is not there,
    is wider than its window, so that a reader has to scroll sideways,
    cuts off text: an element hides what does not fit into it.

--except leaves out what is below a folder; --pictures keeps a picture of each page and width. Exits with 77 where there is no Chromium
(Debian: chromium-headless-shell, or chromium).
"""
import argparse
import base64
import fcntl
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

WIDTHS = {1280: 900, 400: 800}  # of a window and its height [CSS pixels]: a desk, and a telephone
PROGRAMS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
NO_CHROMIUM = 77

# What a page is asked once it stands: pictures that are missing, how much it is too wide, and texts that are cut off. A table, a formula
# or a code may be wider than its box where that box can be scrolled.
QUESTIONS = """(() => {
    const name = (e) => e.tagName.toLowerCase() + (e.id ? '#' + e.id : '') + ' "' + e.textContent.trim().slice(0, 40) + '"';
    const root = document.documentElement, cut = [];
    for (const e of document.body.querySelectorAll('*')) {
        const style = getComputedStyle(e), box = e.getBoundingClientRect();
        const hides = [style.overflowX, style.overflowY].map((s) => s === 'hidden' || s === 'clip');
        if (box.width < 2 || box.height < 2 || style.visibility === 'hidden' || !e.textContent.trim() || e.closest('svg')) continue;
        if ((hides[0] && e.scrollWidth > e.clientWidth + 1) || (hides[1] && e.scrollHeight > e.clientHeight + 1)) cut.push(name(e));
    }
    const wide = root.scrollWidth - root.clientWidth;
    const clipped = (e) => e !== document.body && (getComputedStyle(e).overflowX !== 'visible' || clipped(e.parentElement));
    const widest = wide <= 0 ? [] : [...document.body.querySelectorAll('*')].filter(
        (e) => e.getBoundingClientRect().right > root.clientWidth + 1 && e.getBoundingClientRect().width > 1 &&
               getComputedStyle(e).position !== 'fixed' && !clipped(e.parentElement));
    return {missing: [...document.images].filter((i) => !(i.complete && i.naturalWidth > 0)).map((i) => i.getAttribute('src')),
            wide: wide, widest: widest.length ? name(widest[0]) : '', cut: cut};
})()"""


class Chromium:
    """A browser that is spoken to by pipes (the protocol of its developer tools), with one page."""

    def __init__(self, program, profile):
        ours_in, theirs_out = os.pipe()
        theirs_in, ours_out = os.pipe()

        def arrange():  # it reads 3 and writes 4
            read, write = fcntl.fcntl(theirs_in, fcntl.F_DUPFD, 10), fcntl.fcntl(theirs_out, fcntl.F_DUPFD, 10)
            os.dup2(read, 3)
            os.dup2(write, 4)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--remote-debugging-pipe",
             "--disable-background-networking", "--disable-component-update", "--host-resolver-rules=MAP * ~NOTFOUND",
             f"--user-data-dir={profile}"],
            preexec_fn=arrange, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in), os.close(theirs_out)
        self.reader, self.writer = os.fdopen(ours_in, "rb"), os.fdopen(ours_out, "wb")
        self.waiting, self.number, self.events, self.session = b"", 0, [], None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def message(self):
        while b"\0" not in self.waiting:
            part = os.read(self.reader.fileno(), 1 << 16)
            if not part:
                sys.exit("check_browser: Chromium ended before it was asked to")
            self.waiting += part
        text, _, self.waiting = self.waiting.partition(b"\0")
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        asked = {"id": self.number, "method": method, "params": parameters} | ({"sessionId": self.session} if self.session else {})
        self.writer.write(json.dumps(asked).encode() + b"\0")
        self.writer.flush()
        while True:
            answer = self.message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    sys.exit(f"check_browser: Chromium refuses {method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def value(self, script):
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        return result["result"].get("value")

    def open(self, address):
        """Waits until a page and its pictures stand; self.events has what happens meanwhile. Says what is wrong if there is no such page."""
        self.events = []
        failed = self.call("Page.navigate", url=address).get("errorText")
        if failed:
            return failed
        while not any(event.get("method") == "Page.loadEventFired" for event in self.events):
            self.events.append(self.message())
        self.value("Promise.all([...document.images].map((i) => { i.loading = 'eager'; return i.decode().catch(() => 0); }))"
                   ".then(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))))")

    def close(self):
        self.call("Browser.close")
        self.process.wait(30)


def faults_of(events):
    """What events of a page say against it."""
    asked = {}
    for event in events:
        about = event.get("params", {})
        if event.get("method") == "Network.requestWillBeSent":
            asked[about["requestId"]] = address = about["request"]["url"]
            if urllib.parse.urlsplit(address).scheme not in ("file", "data", "blob", "about"):
                yield f"asks the network for {address}"
        elif event.get("method") == "Network.loadingFailed" and asked.get(about["requestId"], "").startswith("file:"):
            yield f"loads {asked[about['requestId']]}, which is not there"
        elif event.get("method") == "Runtime.exceptionThrown":
            detail = about["exceptionDetails"]
            text = detail.get("exception", {}).get("description", detail["text"])
            yield f"raises {text.splitlines()[0]} ({detail.get('url', 'inline').rsplit('/', 1)[-1]}:{detail['lineNumber'] + 1})"
        elif event.get("method") == "Runtime.consoleAPICalled" and about["type"] in ("error", "assert"):
            yield "writes an error to the console: " + " ".join(str(a.get("value", a.get("description"))) for a in about["args"])
        elif event.get("method") == "Log.entryAdded" and about["entry"]["level"] == "error" and about["entry"]["source"] != "network":
            yield f"writes an error to the console: {about['entry']['text']}"


def look(browser, page, pictures, name):
    for width, height in WIDTHS.items():
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        failed = browser.open(page.as_uri())
        if failed:
            yield f"cannot be opened: {failed}"
            return
        seen = browser.value(QUESTIONS)
        yield from faults_of(browser.events)
        yield from (f"shows a picture that is not there: {picture}" for picture in seen["missing"])
        if seen["wide"] > 0:
            yield f"is {seen['wide']} pixels wider than a window of {width}: {seen['widest']}"
        yield from (f"cuts off a text in a window of {width}: {text}" for text in seen["cut"])
        if pictures:
            whole = browser.call("Page.getLayoutMetrics")["cssContentSize"]
            clip = {"x": 0, "y": 0, "width": width, "height": min(whole["height"], 6000), "scale": 1}
            shot = browser.call("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip=clip)
            (pictures / f"{name}.{width}.png").write_bytes(base64.b64decode(shot["data"]))


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("paths", nargs="+", type=pathlib.Path, metavar="PATH")
    options.add_argument("--except", dest="left_out", action="append", default=[], type=pathlib.Path, metavar="FOLDER")
    options.add_argument("--pictures", type=pathlib.Path, metavar="FOLDER")
    asked = options.parse_args()
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if not program:
        print("check_browser: there is no Chromium; Debian's package is chromium-headless-shell")
        sys.exit(NO_CHROMIUM)
    left_out = [folder.resolve() for folder in asked.left_out]
    pages = [page for path in map(pathlib.Path.resolve, asked.paths) for page in (sorted(path.rglob("*.html")) if path.is_dir() else [path])
             if not any(folder in page.parents for folder in left_out)]
    assert pages, f"no page found in {asked.paths}"
    if asked.pictures:
        asked.pictures.mkdir(parents=True, exist_ok=True)
    base = pathlib.Path(os.path.commonpath([page.parent for page in pages]))
    wrong = []
    with tempfile.TemporaryDirectory() as profile:
        browser = Chromium(program, profile)
        for page in pages:
            name = str(page.relative_to(base))
            wrong += [f"{name} {fault}" for fault in look(browser, page, asked.pictures, name.replace("/", "+").removesuffix(".html"))]
        browser.close()
    if wrong:
        sys.exit("\n".join(sorted(set(wrong))))
    print(f"{len(pages)} pages stand in Chromium, {' and '.join(map(str, WIDTHS))} pixels wide: no error, no request to the network, "
          "nothing missing or cut off")


main()
