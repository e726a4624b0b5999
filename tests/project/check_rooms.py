"""check_rooms.py SOURCE LIST: rooms, which are the folders of a layer, include each other without cycles, except along the includes
between rooms that LIST names ("from -> to", one per line). The list may only shrink: a line that closes no cycle any more is
an error, too."""
import pathlib
import re
import sys
from collections import defaultdict

LAYERS = ("base", "geometry", "mesh", "contact", "dynamics", "solid", "ranks", "run", "input")
INCLUDE = re.compile(r'^\s*#\s*include\s*"abut/(\w+)/([\w/]*?)/?(\w+\.\w+)"')


def room_includes(root):
    """{room: {other room of its layer: ["file:line includes header"]}}"""
    includes = defaultdict(lambda: defaultdict(list))
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*.[ch]pp")):
            room = path.parent.relative_to(root).as_posix()
            for number, line in enumerate(path.read_text().splitlines(), 1):
                found = INCLUDE.match(line)
                if not found or found[1] != layer:
                    continue
                other = "/".join(part for part in (layer, found[2]) if part)
                if other != room:
                    where = f"{path.relative_to(root).as_posix()}:{number} includes {other}/{found[3]}"
                    includes[room][other].append(where)
    return includes


def reached(includes, start):
    rooms, open_rooms = set(), [start]
    while open_rooms:
        for other in includes.get(open_rooms.pop(), ()):
            if other not in rooms:
                rooms.add(other)
                open_rooms.append(other)
    return rooms


def in_cycles(includes):
    """{"from -> to": places} of all includes between rooms that lie on a cycle."""
    return {f"{room} -> {other}": places for room, others in includes.items() for other, places in others.items()
            if room in reached(includes, other)}


def main():
    root, listed = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    lines = [line.split("#")[0].strip() for line in listed.read_text().splitlines()]
    allowed = [line for line in lines if line]
    includes = room_includes(root)
    assert includes, f"no room of {root} includes another: nothing was looked at"
    cycles = in_cycles(includes)
    wrong = [f"{edge} closes a cycle: {'; '.join(cycles[edge][:5])}" for edge in sorted(cycles) if edge not in allowed]
    wrong += [f"{listed.name}: {edge} closes no cycle any more: remove the line" for edge in allowed if edge not in cycles]
    if allowed != sorted(set(allowed)):
        wrong.append(f"{listed.name}: sort the lines, and write each once")
    if wrong:
        sys.exit("\n".join(wrong) + "\nMove what both rooms need to a third one, or below both.")
    rooms = {room for edge in cycles for room in edge.split(" -> ")}
    print(f"{len(rooms)} rooms are in cycles, as listed")


main()
