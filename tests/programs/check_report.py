"""check_report.py BROWSER ABUT SCENE: runs a small scene and looks at the report that it leaves in a headless browser, as wide as
a desk and as narrow as a telephone, without network. Every figure has to be there with the value of summary.json, every picture
has to be drawn and to lie within its column, nothing may stick out, and no text may lie on another in a picture."""
import html.parser
import json
import pathlib
import subprocess
import sys
import tempfile

MEASURE = """<!DOCTYPE html><html><body style="margin:0">
<iframe id="page" src="report.html" style="border:0;width:WIDTHpx;height:900px"></iframe><pre id="answer"></pre><script>
document.getElementById("page").onload = function () {
    const page = this.contentDocument, root = page.documentElement;
    const answer = {width: root.clientWidth, reaches: root.scrollWidth, height: root.scrollHeight, title: page.title,
                    data: {}, pictures: [], outside: [], requests: []};
    for (const e of page.querySelectorAll("*:not(a)"))  // a link is followed by its reader alone
        for (const name of ["src", "srcset", "href", "xlink:href", "data", "poster", "background"]) {
            const to = e.getAttribute(name);
            if (to && !to.startsWith("#") && !to.startsWith("data:")) answer.requests.push(e.tagName + " " + to);
        }
    for (const text of [...page.querySelectorAll("style")].map(e => e.textContent)
                           .concat([...page.querySelectorAll("[style]")].map(e => e.getAttribute("style"))))
        if (/@import|url\(\s*["']?(?!#|data:)/.test(text)) answer.requests.push(text.slice(0, 80));
    for (const d of page.querySelectorAll("data[id]")) answer.data[d.id] = [d.getAttribute("value"), d.textContent];
    for (const svg of page.querySelectorAll("svg")) {
        const box = svg.getBoundingClientRect();
        const texts = [...svg.querySelectorAll("text")].map(t => [t.textContent, t.getBoundingClientRect()]);
        const clashes = [];
        texts.forEach(([a, x], i) => texts.slice(i + 1).forEach(([b, y]) => {
            const wide = Math.min(x.right, y.right) - Math.max(x.left, y.left);
            const high = Math.min(x.bottom, y.bottom) - Math.max(x.top, y.top);
            if (wide > 1 && high > 3) clashes.push([a, b]);
        }));
        const lines = [...svg.querySelectorAll("polyline, path")].filter(l => l.getTotalLength() > 20).length;
        answer.pictures.push({width: box.width, height: box.height, right: box.right, lines: lines,
                              scrolls: getComputedStyle(svg.parentElement).overflowX == "auto", clashes: clashes});
    }
    for (const e of page.body.querySelectorAll("*")) {
        const box = e.getBoundingClientRect();
        if (box.width > 0 && box.right > root.clientWidth + 1 && !e.closest("svg") && !e.closest(".scroll"))
            answer.outside.push(e.tagName + ": " + e.textContent.slice(0, 40));
    }
    document.getElementById("answer").textContent = JSON.stringify(answer);
};
</script></body></html>
"""


class Answer(html.parser.HTMLParser):
    """The text of the element "answer"."""

    def __init__(self):
        super().__init__()
        self.inside, self.text = False, ""

    def handle_starttag(self, tag, attributes):
        self.inside = dict(attributes).get("id") == "answer"

    def handle_endtag(self, tag):
        self.inside = False

    def handle_data(self, data):
        if self.inside:
            self.text += data


def look(browser, folder, width, report="report.html"):
    """What a page shows in a window of that width [pixels]."""
    page = pathlib.Path(folder, "measure.html")
    page.write_text(MEASURE.replace("WIDTH", str(width)).replace("report.html", report))
    for _ in range(3):  # on a busy machine a browser may give its page away before the frame in it has loaded
        with tempfile.TemporaryDirectory() as profile:
            shown = subprocess.run(
                [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--user-data-dir=" + profile, "--host-resolver-rules=MAP * ~NOTFOUND", "--allow-file-access-from-files",
                 f"--window-size={width},900", "--virtual-time-budget=10000", "--dump-dom", page.as_uri()],
                check=True, capture_output=True, text=True, timeout=120).stdout
        answer = Answer()
        answer.feed(shown)
        if answer.text:
            return json.loads(answer.text)
    raise AssertionError(shown[-2000:])


def at(summary, place):
    """What stands at a place such as "bodies.0.mass"."""
    for key in place.split("."):
        summary = summary[int(key) if isinstance(summary, list) else key]
    return summary


def main():
    browser, program, scene = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", scene, "--set", "values.size=0.25", "--steps", "60", "--frames", "2", "--quiet", "--out", folder], check=True)
        summary = json.loads(pathlib.Path(folder, "summary.json").read_text())
        for width in (1280, 390):
            page = look(browser, folder, width)
            assert page["title"].startswith("slipping_cylinders"), page["title"]
            assert width - 20 <= page["width"] <= width and page["reaches"] <= page["width"], page
            assert not page["outside"], page["outside"]
            assert len(page["data"]) > 20, len(page["data"])
            for place, (value, text) in page["data"].items():
                assert json.loads(value) == at(summary, place), (place, value)
                assert text.strip(), place
            assert len(page["pictures"]) >= 3, page["pictures"]
            for picture in page["pictures"]:
                assert picture["width"] > 400 and picture["height"] > 150, picture
                assert picture["right"] <= page["width"] or picture["scrolls"], picture
                assert picture["lines"] > 0, picture
                assert not picture["clashes"], picture["clashes"]
            assert not page["requests"], page["requests"]
        # A page that asks for something is found out.
        text = pathlib.Path(folder, "report.html").read_text().replace("</body>", '<img src="beside.png" alt=""/></body>')
        pathlib.Path(folder, "asks.html").write_text(text)
        assert look(browser, folder, 1280, "asks.html")["requests"], "a request of the page was not seen"


if __name__ == "__main__":
    main()
