#!/usr/bin/env python3
"""Bars of few cells across: how stiff they are in bending and in torsion, by shape of the cells, beside beam theory and Saint-Venant's.

    check_bars.py build/dev/bin --list
    check_bars.py build/dev/bin --table
"""
import itertools
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


def shear(y, z):
    """tau_xy and tau_xz over G k of a twisted square -1/2 < y, z < 1/2: derivatives of the stress function (Timoshenko and Goodier,
    section 109)."""
    def along_z(y, z):
        terms = ((i, (2 * i + 1) * math.pi) for i in range(40))
        return -sum((-1)**i * 8 / m**2 * math.cos(m * y) * math.sinh(m * z) / math.cosh(m / 2) for i, m in terms)
    return along_z(y, z), -along_z(z, y)


# Gauss points on 0 < t < 1, with their weights.
GAUSS = [((1 + sign * root) / 2, weight / 2) for root, weight in
         ((0.2386191860831969, 0.4679139345726910), (0.6612093864662645, 0.3607615730481386), (0.9324695142031521, 0.1713244923791704))
         for sign in (-1, 1)]


def pieces_of_brick(shape):
    """The cells that a unit brick is cut into: their points (y, z, weight), and the sides (axis, end) of the brick that they have.
    Prisms are cut through the edges along z; pyramids meet in the middle."""
    square = [(a, b, u * v) for a, u in GAUSS for b, v in GAUSS]
    if shape == "hexahedron":
        return [(square, ((0, 0), (0, 1), (1, 0), (1, 1)))]
    if shape == "prism":
        return [([(y, z, w * (y if end else 1 - y)) for y, z, w in square], ((0, end), (1, 0), (1, 1))) for end in (0, 1)]
    away = lambda t, base: 0.5 + t * (base - 0.5)
    along_bar = [(away(t, a), away(t, b), w * v * t * t / 2) for a, b, w in square for t, v in GAUSS]
    pieces = [(along_bar, ()), (along_bar, ())]
    for end in (0, 1):
        across = [(away(t, end), away(t, a), u * v * t * t / 2) for t, v in GAUSS for a, u in GAUSS]
        pieces += [(across, ((0, end),)), ([(z, y, w) for y, z, w in across], ((1, end),))]
    return pieces


def share_of_means(shape, across, bare_sides=True):
    """Energy per length over G J k^2/2, of cells that each bear the mean of the exact stress in them. With `bare_sides` those at a
    free side bear none across it."""
    total = 0.0
    for i, j, (points, sides) in itertools.product(range(across), range(across), pieces_of_brick(shape)):
        bare = {axis for axis, end in sides if bare_sides and (i, j)[axis] == end * (across - 1)}
        stresses = [(w, shear((i + y) / across - 0.5, (j + z) / across - 0.5)) for y, z, w in points]
        volume = sum(w for *_, w in points)
        total += sum(sum(w * stress[axis] for w, stress in stresses)**2 / volume for axis in (0, 1) if axis not in bare)
    return total / across**2 / TORSION


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
def bricks_prisms_and_pyramids_twist_as_a_bar_with_the_mean_stress_of_each_and_none_across_its_free_sides(programs):
    """Within 2/n^2 of it: 13 % with four across, 6 % with six."""
    for shape in ("hexahedron", "prism", "pyramid"):
        require_stiffness(programs, "twist", shape, (4, 6), lambda across: share_of_means(shape, across), lambda across: 2 / across**2)


@claim
def tetrahedra_twist_as_saint_venants_bar_within_what_bricks_of_their_size_miss(programs):
    """Of the mean stress of each brick: 22 % with three across."""
    require_stiffness(programs, "twist", "tetrahedron", (3,), lambda across: 1.0,
                      lambda across: 1 - share_of_means("hexahedron", across, bare_sides=False))


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
