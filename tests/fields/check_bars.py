#!/usr/bin/env python3
"""Bars of few cells across: how stiff they are in bending and in torsion, by shape of the cells.

    check_bars.py build/dev/bin --list
    check_bars.py build/dev/bin --table
"""
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
from abut_runs import Claims, Run, main, near, require  # noqa: E402

claim = Claims()

ACROSS = (2, 3, 4, 6, 8)
SPACE = ("hexahedron", "tetrahedron", "prism", "pyramid")
SHAPES = {"bend": ("quadrangle", "triangle", *SPACE), "twist": SPACE}
LENGTH, POISSON, TURN = 3, 0.3, 1e-4  # of a side of 1 m; per length [1/m]
TORSION = 0.140577  # of a square (Timoshenko and Goodier, Theory of Elasticity, section 109)


def exact_energy(load, dim):
    """E I k^2 L/2 with the modulus of plane strain in the plane, and G J k^2 L/2 [J]. E = 1 Pa."""
    of_section = TORSION / (2 * (1 + POISSON)) if load == "twist" else (1 if dim == 3 else 1 / (1 - POISSON**2)) / 12
    return 0.5 * of_section * TURN**2 * LENGTH


def stiffness(programs, load, shape, across):
    """Energy over the exact one, with ends that have its displacement: along the bar (bend) or across it (twist), free otherwise."""
    dim = 3 if shape in SPACE else 2
    vector = lambda *parts: "[" + ", ".join(parts[:dim]) + "]"
    axes, value = (["x"], lambda x: vector(f'"{-TURN * x}*y"', "0", "0")) if load == "bend" else \
        (["y", "z"], lambda x: vector("0", f'"{-TURN * x}*z"', f'"{TURN * x}*y"'))
    supports = "".join(f'[supports.{group}]\ngroup = "bar.{group}"\nconstraint = "components"\ncomponents = {axes}\nvalue = {value(x)}\n'
                       for group, x in (("xmin", -LENGTH / 2), ("xmax", LENGTH / 2)))
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "bar.toml"
        scene.write_text(f"""dim = {dim}
energy_scale = 1e-9
[bodies.bar]
shape = "structured_box"
lower = {vector(str(-LENGTH / 2), "-0.5", "-0.5")}
upper = {vector(str(LENGTH / 2), "0.5", "0.5")}
counts = {vector(str(LENGTH * across), str(across), str(across))}
cells = "{shape}"
young = 1.0
poisson = {POISSON}
density = 1.0
kinematics = "small"
{supports}[run]
steps = 1
settle = true
[output]
frames = 0
""")
        return Run(programs, scene, seconds=900).require_end().rows()[-1]["potential"] / exact_energy(load, dim)


def table_of_page():
    text = (HERE.parent.parent / "docs/validation.md").read_text().partition("### Bars of few cells")[2].partition("\n### ")[0]
    rows = re.findall(r"^\| (bend|twist) \| (\w+) \| ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", text, re.M)
    return {(load, shape, across): float(ratio) for load, shape, *ratios in rows for across, ratio in zip(ACROSS, ratios) if ratio.strip()}


@claim
def bars_of_few_cells_are_as_stiff_as_the_page_says_and_nearer_to_theory_with_more(programs):
    page = table_of_page()
    require(len(page) > 30, "the table of the page is not read")
    for load, shape, counts in (("bend", "quadrangle", (4, 8)), ("bend", "triangle", (4, 8)), ("bend", "hexahedron", (3,)),
                                ("twist", "hexahedron", (3,)), ("twist", "tetrahedron", (3,))):
        found = [stiffness(programs, load, shape, across) for across in counts]
        for across, ratio in zip(counts, found):
            near(ratio, page[load, shape, across], 6e-4, f"the page on {load}, {across} {shape}s across")
        errors = [abs(ratio - 1) for ratio in found]
        require(errors == sorted(errors, reverse=True), f"{load}, {shape}: {found} do not come nearer to 1")


def tell_table(folder):
    for load, shapes in SHAPES.items():
        for shape in shapes:
            ratios = [f"{stiffness(folder, load, shape, across):.3f}" for across in ACROSS]
            print(f"| {load} | {shape} | " + " | ".join(ratios) + " |", flush=True)


if __name__ == "__main__":
    if sys.argv[2:] == ["--table"]:
        tell_table(pathlib.Path(sys.argv[1]))
    else:
        sys.exit(main(claim))
