"""check_comments.py SOURCE [LIST]: doc comments begin with their subject, and lines end at column 125, except for as many of each layer
as LIST allows ("LAYER MEASURE NUMBER", one per line). The list may only shrink: a number that is not reached any more is an error, too.
Without LIST it prints all places.

Measures: `without_subject` counts blocks of lines "///" (not "///<") whose first word is What, Of, Where, Those, That or The same;
`long_lines` counts lines of more than 125 characters, of code as well."""
import pathlib
import re
import sys

LAYERS = ("base", "geometry", "mesh", "contact", "dynamics", "solid", "run", "input", "apps", "studies", "ranks", "bindings")
COLUMNS = 125
DOC = re.compile(r"\s*///(?!<)(.*)")
NO_SUBJECT = re.compile(r"\s*(?:What|Of|Where|Those|That|The same)\b")
REMEDY = {
    "without_subject": "begin with what is described: \"Energy that both have dissipated\", not \"What both have dissipated\"",
    "long_lines": f"break lines at column {COLUMNS}",
}


def without_subject(lines):
    """Numbers of the lines at which such a block begins."""
    in_block = False
    for number, line in enumerate(lines, 1):
        found = DOC.match(line)
        if found and not in_block and NO_SUBJECT.match(found[1]):
            yield number
        in_block = bool(found)


def long_lines(lines):
    return (number for number, line in enumerate(lines, 1) if len(line) > COLUMNS)


def places_of(root):
    """{"LAYER MEASURE": ["file:line"]}"""
    places = {}
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*.[ch]pp")):
            lines = path.read_text().split("\n")
            for measure in (without_subject, long_lines):
                found = [f"{path.relative_to(root).as_posix()}:{number}" for number in measure(lines)]
                places.setdefault(f"{layer} {measure.__name__}", []).extend(found)
    return places


def numbers_in(path):
    lines = [line.split("#")[0].split() for line in path.read_text().splitlines()]
    return {f"{line[0]} {line[1]}": int(line[2]) for line in lines if line}


def main():
    root = pathlib.Path(sys.argv[1])
    places = places_of(root)
    assert places, f"no source of a layer found in {root}"
    if len(sys.argv) < 3:
        print("\n".join(f"{place}: {key.split()[1]}" for key, found in places.items() for place in found))
        return
    listed = pathlib.Path(sys.argv[2])
    allowed = numbers_in(listed)
    now = {key: len(found) for key, found in places.items()}
    wrong = [f"{key} is {number}, {allowed.get(key, 0)} are allowed: {REMEDY[key.split()[1]]}"
             for key, number in now.items() if number > allowed.get(key, 0)]
    wrong += [f"{listed.name}: {key} is {now.get(key, 0)} now, not {number}: " +
              ("lower the number" if now.get(key, 0) else "remove the line")
              for key, number in allowed.items() if now.get(key, 0) < number]
    wrong += [f"{listed.name}: {key} 0 says nothing: remove the line" for key, number in allowed.items() if number == 0]
    if wrong:
        sys.exit("\n".join(wrong) + "\nWithout the list as argument the check prints all places.")
    subjects, columns = (sum(number for key, number in now.items() if key.endswith(measure)) for measure in REMEDY)
    print(f"{subjects} doc comments have no subject at their beginning and {columns} lines are long, as listed")


main()
