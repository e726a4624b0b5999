"""check_messages.py SOURCE: no message of a layer that users of scenes hear of names anything of C++ (Scope::name) unless
run/user_words.cpp has a word for it, and what is said without an error, warnings and tables, names nothing of C++ at all."""
import pathlib
import re
import sys

TABLE = "run/user_words.cpp"
LAYERS = ("base", "geometry", "mesh", "contact", "dynamics", "solid", "ranks", "run", "input", "apps")
PLAIN = ("run/words/warnings.cpp", "run/words/summary.cpp", "run/report", "input", "apps/abut", "apps/support")
NAME = re.compile(r"\b[A-Z][A-Za-z]*::[a-z_A-Z]\w*|\babut::\w+")
TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<text>(?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\\n]|\\.)\'', re.S)


def texts(source):
    """(line, text) of the literals of a source, comments left out."""
    for found in TOKEN.finditer(source):
        text = found["raw"] if found["raw"] is not None else found["text"]
        if text is not None:
            yield source.count("\n", 0, found.start()) + 1, text


def names_in(path):
    return [(line, name) for line, text in texts(path.read_text()) for name in NAME.findall(text)]


def sources(root, folder):
    path = root / folder
    found = [path] if path.is_file() else path.rglob("*")
    return sorted(file for file in found if file.suffix in (".cpp", ".hpp", ".h", ".cu"))


def main():
    root = pathlib.Path(sys.argv[1])
    known = {name for _, name in names_in(root / TABLE)}
    assert len(known) > 20, "the table of words is not read"
    assert names_in(pathlib.Path(__file__).parent / "fixtures/messages.cpp") == [(2, "Scene::spin"), (4, "MeshOptions::split")]
    wrong = []
    for folder in LAYERS:
        for path in sources(root, folder):
            place = str(path.relative_to(root))
            if place == TABLE:
                continue
            for line, name in names_in(path):
                if name not in known:
                    wrong.append(f"{place}:{line}: {name} reaches users as it is. Say it in words, or give it one in {TABLE}.")
                elif place.startswith(PLAIN):
                    wrong.append(f"{place}:{line}: {name} is in a text that nobody puts into words. Say it in words.")
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


main()
