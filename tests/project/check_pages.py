"""check_pages.py SOURCE: every file and every heading that a Markdown page links to is there, every formula that begins ends in its
paragraph, and what is to be cited has the version of the build."""
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^()\s]+)\)")
CODE = re.compile(r"^ *```.*?^ *```", re.S | re.M)


def anchors(page):
    """Of the headings of a page, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.+?) *$", CODE.sub("", page.read_text()), re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text).lower()).replace(" ", "-") for text in headings}


def faults_of(root, page):
    text = CODE.sub(lambda code: "\n" * code[0].count("\n"), page.read_text())
    for found in LINK.finditer(text):
        target, _, anchor = found[1].partition("#")
        if ":" in target:
            continue  # of another site
        path = (page.parent / target) if target else page
        where = f"{page.relative_to(root).as_posix()}:{text.count(chr(10), 0, found.start()) + 1}"
        if not path.exists():
            yield f"{where}: there is no {target}"
        elif anchor and path.suffix == ".md" and anchor not in anchors(path):
            yield f"{where}: {path.name} has no heading #{anchor}"
    lines = re.sub(r"`[^`]*`", lambda code: "\n" * code[0].count("\n"), re.sub(r"^ {4}.*", "", text, flags=re.M))
    for paragraph in re.finditer(r"(?:.+\n?)+", lines):
        if paragraph[0].count("$") % 2:
            where = f"{page.relative_to(root).as_posix()}:{lines.count(chr(10), 0, paragraph.start()) + 1}"
            yield f"{where}: a formula of this paragraph has one $; write code as `$HOME`"


def wrong_versions(root):
    if not (root / "CITATION.cff").exists():
        return
    version = re.search(r"^project\(abut VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text(), re.M)[1]
    for name in ("CITATION.cff", "docs/cite.md", "docs/index.md"):
        found = re.search(r"(?:^ *version *[:=] *{?|is version )([0-9]+[.][0-9]+[.][0-9]+)", (root / name).read_text(), re.M)
        if not found or found[1] != version:
            yield f"{name}: the version is {found and found[1]}, the build has {version}"


def main():
    root = pathlib.Path(sys.argv[1])
    pages = sorted(root.glob("*.md")) + sorted(root.glob("docs/*.md")) + sorted(root.glob("*/README.md"))
    assert pages, f"no page found in {root}"
    wrong = [fault for page in pages for fault in faults_of(root, page)]
    wrong += wrong_versions(root)
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"all links of {len(pages)} pages lead somewhere")


main()
