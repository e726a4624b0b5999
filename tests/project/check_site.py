"""check_site.py FOLDER [PART]: every link of the HTML pages in a folder leads to a file and a place that are there, and no page asks the
network. In the folder PART of it, which another program wrote, places within pages are not looked for. No two links of the sidebar have
one name.

Links that a reader may follow to another site are left alone; pictures, scripts, styles and fonts must be in the folder.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("object", "data"), ("video", "src")}
OF_STYLE = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")


class Page(html.parser.HTMLParser):
    """Places of a page (ids and names), what it links to and what it loads, with lines, and the names of the links in its sidebar."""

    def __init__(self, path):
        super().__init__()
        self.places, self.links, self.loads = set(), [], []
        self.sidebar, self.in_sidebar = [], False
        self.feed(path.read_text(errors="replace"))

    def handle_starttag(self, tag, attributes):
        if "sidebar-tree" in (dict(attributes).get("class") or ""):
            self.in_sidebar = True
        if tag == "a" and self.in_sidebar:
            self.sidebar.append("")
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.places.add(value)
            elif (tag, name) in LOADED:
                self.loads.append((self.getpos()[0], value or ""))
            elif tag == "a" and name == "href":
                self.links.append((self.getpos()[0], value or ""))
            elif name == "style":
                self.loads += [(self.getpos()[0], a or b) for a, b in OF_STYLE.findall(value or "")]

    def handle_endtag(self, tag):
        self.in_sidebar = self.in_sidebar and tag != "aside"

    def handle_data(self, data):
        if self.in_sidebar and self.sidebar:
            self.sidebar[-1] += data.strip()


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    foreign = root / sys.argv[2] if len(sys.argv) > 2 else None
    pages = {path: Page(path) for path in sorted(root.rglob("*.html"))}
    assert pages, f"no page found in {root}"
    wrong = []

    def look(path, line, target, loads):
        split = urllib.parse.urlsplit(target)
        where = f"{path.relative_to(root)}:{line}"
        if split.scheme in ("data", "javascript"):
            return
        if split.scheme or split.netloc:
            if loads:
                wrong.append(f"{where}: {target} is a request to the network")
            return
        aim = (path.parent / urllib.parse.unquote(split.path)).resolve() if split.path else path
        if aim.is_dir():
            aim /= "index.html"
        place = urllib.parse.unquote(split.fragment)
        if not aim.exists() or (root != aim and root not in aim.parents):
            wrong.append(f"{where}: {target} is not there")
        elif place and foreign not in path.parents and aim in pages and place not in pages[aim].places:
            wrong.append(f"{where}: {target}: the page has no such place")

    for path, page in pages.items():
        for line, target, loads in sorted([(*link, False) for link in page.links] + [(*load, True) for load in page.loads]):
            look(path, line, target, loads)
    for path in sorted(root.rglob("*.css")):
        for number, text in enumerate(path.read_text(errors="replace").splitlines(), 1):
            for a, b in OF_STYLE.findall(text):
                if not (a or b).startswith("#"):
                    look(path, number, a or b, loads=True)
    names = pages[root / "index.html"].sidebar if root / "index.html" in pages else []
    wrong += [f"index.html: the sidebar has two links '{name}'" for name in names if names.count(name) > 1]
    if wrong:
        sys.exit("\n".join(dict.fromkeys(wrong)))
    print(f"all links of {len(pages)} pages lead somewhere, and none of them asks the network")


main()
