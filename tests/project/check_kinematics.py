"""check_kinematics.py SOURCE: no line outside of solid/kinematics asks which kinematics a body has. Code asks for a property
(kinematics/properties.hpp), or whether features go together (combinations/combinations.hpp). Studies and tests, which choose kinematics, may."""
import pathlib
import re
import sys

FOLDERS = ("base", "geometry", "mesh", "contact", "dynamics", "solid", "ranks", "run", "input", "apps", "bindings", "benchmarks",
           "examples")
ROOM = "solid/kinematics"
VALUE = r"\b(?:\w+::)*\bKinematics::\w+"
ASKS = re.compile(rf"[!=]=\s*{VALUE}|{VALUE}\s*[!=]=|\bcase\s+{VALUE}|\b(?:find|count|contains)\w*\s*\([^;]*{VALUE}")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')


def asks_in(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        code = STRING.sub('""', line).split("//")[0]
        if ASKS.search(code):
            yield number, line.strip()


def main():
    root = pathlib.Path(sys.argv[1])
    paths = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*.[ch]pp"))
             if not path.relative_to(root).as_posix().startswith(ROOM + "/")]
    assert paths, f"no source below {root}: nothing was looked at"
    wrong = [f"{path.relative_to(root).as_posix()}:{number} asks for a kinematics by name: {line}"
             for path in paths for number, line in asks_in(path)]
    if wrong:
        sys.exit("\n".join(wrong) + f"\nAsk for what it is ({ROOM}/properties.hpp), or whether features go together (solid/combinations).")
    print(f"{len(paths)} sources ask for no kinematics by name")


main()
