"""public_headers.py PAGE HEADERS [--write]: whether the table of PAGE lists the public headers (layer/name.hpp, separated by commas),
as the build has them. With --write the table is written."""
import pathlib
import sys

BEGIN = "<!-- written by: cmake --build --preset dev --target write_public_headers -->\n"
END = "<!-- end of what is written -->\n"


def table(headers):
    layers = {}
    for header in headers:
        layer, name = header.removesuffix(".hpp").split("/", 1)
        layers.setdefault(layer, []).append(name)
    rows = [f"| {layer} | {', '.join(f'`{name}`' for name in sorted(names))} |\n" for layer, names in layers.items()]
    return "| layer | headers, as `\"abut/<layer>/<header>.hpp\"` |\n|---|---|\n" + "".join(rows)


def main():
    page, headers = pathlib.Path(sys.argv[1]), [header for header in sys.argv[2].split(",") if header]
    assert headers, "no public header is given"
    before, _, rest = page.read_text().partition(BEGIN)
    listed, _, after = rest.partition(END)
    expected = table(headers)
    if "--write" in sys.argv[3:]:
        page.write_text(before + BEGIN + expected + END + after)
    elif listed != expected:
        wrong = sorted(set(listed.splitlines()) ^ set(expected.splitlines()))
        sys.exit(f"{page.name} lists other public headers than the build has:\n" + "\n".join(wrong) +
                 "\nWrite the list: cmake --build --preset dev --target write_public_headers")


main()
