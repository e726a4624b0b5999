#!/usr/bin/env python3
"""Bars of few cells across: how stiff they are in bending and in torsion, by shape of the cells, beside beam theory and Saint-Venant's.

    check_bars.py build/dev/bin --list
    check_bars.py build/dev/bin --table
"""
import math
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


def share_of_layers(across):
    """Of E I k^2/2, what cells have that bear the mean stress of their layer: sum h y^2 over 1/12."""
    return 1 - 1 / across**2


def mean_shear(y, z, size):
    """Mean over the square from (y, z) to (y + size, z + size) of tau_xy of a twisted square -1/2 < y, z < 1/2, over G k: that of
    d phi/dz of the stress function (Timoshenko and Goodier, section 109), a series of cosh(m z) cos(m y)."""
    total = 0.0
    for i in range(20):
        m = (2 * i + 1) * math.pi
        along_z = (math.cosh(m * (z + size)) - math.cosh(m * z)) / math.cosh(m / 2)
        total -= (-1)**i * 8 / m**4 * along_z * (math.sin(m * (y + size)) - math.sin(m * y))
    return total / size**2


def share_of_bricks(across, bare_sides=True):
    """Of G J k^2/2, what bricks have that bear their mean of the exact stress; with `bare_sides` none across the free sides of
    cells there. Both shears have the same."""
    size = 1 / across
    columns = range(1, across - 1) if bare_sides else range(across)
    return 2 * size**2 / TORSION * sum(mean_shear(i * size - 0.5, j * size - 0.5, size)**2 for i in columns for j in range(across))


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


def require_stiffness(programs, load, shape, counts, expected, tolerance):
    """Bars of `counts` cells across within `tolerance`(across) of what theory expects, and nearer to 1 with more cells; the page has
    them as they are rounded."""
    page, found = table_of_page(), [stiffness(programs, load, shape, across) for across in counts]
    for across, ratio in zip(counts, found):
        near(ratio, expected(across), tolerance(across), f"theory on {load}, {across} {shape}s across")
        near(ratio, page[load, shape, across], 6e-4, f"the page on {load}, {across} {shape}s across")
    errors = [abs(ratio - 1) for ratio in found]
    require(errors == sorted(errors, reverse=True), f"{load}, {shape}: {found} do not come nearer to 1")


@claim
def bricks_bend_as_layers_of_constant_stress_do(programs):
    """These miss 1/n^2 of E I. Within half of that: 0.8 % with eight across."""
    for shape, counts in (("quadrangle", (4, 8)), ("hexahedron", (3, 4))):
        require_stiffness(programs, "bend", shape, counts, share_of_layers, lambda across: 0.5 / across**2)


@claim
def bars_of_other_cells_bend_as_beams_of_second_order_do(programs):
    """Within twice what a constant stress per layer misses: 3 % with eight across, 13 % with four."""
    for shape, counts in (("triangle", (4, 8)), ("tetrahedron", (3, 4)), ("prism", (3, 4)), ("pyramid", (3, 4))):
        require_stiffness(programs, "bend", shape, counts, lambda across: 1.0, lambda across: 2 / across**2)


@claim
def bricks_twist_as_saint_venants_bar_with_the_mean_stress_of_each_and_none_across_its_free_sides(programs):
    """Within 2/n^2 of it: 6 % with six across."""
    require_stiffness(programs, "twist", "hexahedron", (4, 6), share_of_bricks, lambda across: 2 / across**2)


@claim
def tetrahedra_twist_as_saint_venants_bar_within_what_bricks_of_their_size_miss(programs):
    """Of the mean stress of each brick: 22 % with three across."""
    require_stiffness(programs, "twist", "tetrahedron", (3,), lambda across: 1.0, lambda across: 1 - share_of_bricks(across, bare_sides=False))


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
