#!/usr/bin/env python3
"""Metal that contact pushes: forces between planes beside the exact ones, and what flow dissipates.

    check_metal.py build/dev/bin --list
    check_metal.py build/dev/bin --table
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

# A block between two planes, far beyond yield ----------------------------------------------------------------------------

YOUNG, POISSON, YIELD, HARDENING = 1.0, 0.3, 1e-3, 0.05  # [Pa]; a slope of E/21 in tension
SHORTENED = 0.02
SPACE = ("hexahedron", "tetrahedron")
TABLE = {"quadrangle": (4, 8, 12, 16), "triangle": (4, 8, 12, 16), "hexahedron": (4, 6)}


def exact_force(dim, steps=2000):
    """Force over the area at rest, sides free, of von Mises's metal whose energy is quadratic in logarithmic strains: by the radial
    return in small steps. In the plane the third strain is 0 [Pa]."""
    shear = YOUNG / (2 * (1 + POISSON))
    bulk = YOUNG / (3 * (1 - 2 * POISSON))
    plastic, hardened = [0.0, 0.0, 0.0], 0.0

    def step(along, aside):
        """Stress, plastic strain and its equivalent at the end of a step to these strains."""
        elastic = [e - p for e, p in zip((along, aside, aside if dim == 3 else 0.0), plastic)]
        mean = sum(elastic) / 3
        deviator = [2 * shear * (e - mean) for e in elastic]
        size = math.hypot(*deviator)
        flow = max(0.0, (size - math.sqrt(2 / 3) * (YIELD + HARDENING * hardened)) / (2 * shear + 2 / 3 * HARDENING))
        turned = [d / size for d in deviator]
        stress = [3 * bulk * mean + d - 2 * shear * flow * t for d, t in zip(deviator, turned)]
        return stress, [p + flow * t for p, t in zip(plastic, turned)], hardened + math.sqrt(2 / 3) * flow

    for i in range(1, steps + 1):
        along = math.log(1 - SHORTENED * i / steps)
        low, high = 0.0, -2 * along
        for _ in range(60):  # the strain aside at which nothing pushes there
            middle = (low + high) / 2
            low, high = (middle, high) if step(along, middle)[0][1] < 0 else (low, middle)
        stress, plastic, hardened = step(along, low)
    return -stress[0] / (1 - SHORTENED)


def pressed_block(programs, shape, across, kinematics="finite"):
    """A run that shortens the block slowly, and leaves it there until it is at rest."""
    dim = 3 if shape in SPACE else 2
    vector = lambda first, rest: "[" + ", ".join([first] + [rest] * (dim - 1)) + "]"
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "block.toml"
        scene.write_text(f"""dim = {dim}
energy_scale = 1e-6
[bodies.block]
shape = "structured_box"
lower = {vector("0", "0")}
upper = {vector("1", "1")}
counts = {vector(str(across), str(across))}
cells = "{shape}"
young = {YOUNG}
poisson = {POISSON}
density = 1.0
law = "j2"
yield_stress = {YIELD}
hardening = {HARDENING}
mass_damping = 0.5
kinematics = "{kinematics}"
[obstacles.wall]
shape = "plane"
point = {vector("0", "0")}
normal = {vector("1", "0")}
[obstacles.press]
shape = "plane"
point = {vector("1", "0")}
normal = {vector("-1", "0")}
path = {vector(f'"-{SHORTENED}*min(t/320, 1)"', "0")}
[run]
time = 400.0
[output]
frames = 0
forces = true
interval = 49
""")
        return Run(programs, scene, seconds=600).require_end()


def figures_of(run, dim):
    """Force over the exact one, and what faces take of what cells dissipate."""
    force = [row["normal_force"] for row in run.rows("forces.csv") if "press" in (row["body_1"], row["body_2"])][-1]
    flow = run.summary["plasticity"]
    return force / exact_force(dim), flow["dissipated_on_faces"] / flow["dissipated"]


@claim
def metal_that_planes_press_far_beyond_yield_bears_what_statics_allows_and_nears_the_exact_force_with_more_cells(programs):
    """Of n layers those on the planes pull along them by the limit of plane strain at most, 2/sqrt(3) of the flow stress, which is what the
    block bears: n - 2 others are pressed along by as much in all, and bear at most that more. Edges that bear nothing are 2 columns
    of n. Of triangles half a layer touches."""
    for shape, layers, counts in (("quadrangle", 1, (8, 16)), ("triangle", 2, (4, 8))):
        errors = []
        for across in counts:
            force, _ = figures_of(pressed_block(programs, shape, across), 2)
            n = layers * across
            require(1 - 2 / n <= force <= 1 + 2 / (n - 2), f"{across} {shape}s across bear {force:.3f} of the exact force")
            errors.append(abs(force - 1))
        require(errors[1] < errors[0], f"{shape}s: errors {errors} do not fall with more cells")


@claim
def metal_that_planes_press_far_beyond_yield_is_warned_of_and_the_page_says_what_it_bears(programs):
    """Finite blocks: docs/validation.md has force and share of faces as they are rounded; above a share of 0.05 a run warns."""
    text = (HERE.parent.parent / "docs/validation.md").read_text().partition("### Metal between planes")[2].partition("\n### ")[0]
    rows = {(shape, int(across)): (float(force), float(share)) for shape, across, force, share in
            re.findall(r"^\| (\w+) \| (\d+) \| ([\d.]+) \| ([\d.]+) \|$", text, re.M)}
    require(set(rows) == {(shape, across) for shape in TABLE for across in TABLE[shape]}, "the table of the page is not that of the script")
    for shape, across in (("quadrangle", 4), ("quadrangle", 8), ("triangle", 8)):
        run = pressed_block(programs, shape, across)
        for found, of_page, what in zip(figures_of(run, 2), rows[shape, across], ("the force over the exact one", "the share of faces")):
            near(found, of_page, 6e-4, f"the page on {across} {shape}s across: {what}")
        require(run.warns_of("free faces that flow along", "pressed far beyond yield"), f"{across} {shape}s across are not warned of")


# Bodies that collide -----------------------------------------------------------------------------------------------------

def collision(programs, across):
    """Boxes of metal meet at ten times the speed that makes them yield, with friction."""
    body = lambda name, lower, sign: f"""[bodies.{name}]
shape = "structured_box"
lower = {list(lower)}
upper = {[x + 1 for x in lower]}
counts = [{across}, {across}]
young = 1.0
poisson = 0.3
density = 1.0
law = "j2"
yield_stress = 0.01
kinematic_hardening = 0.3
kinematics = "small"
velocity = [{0.1 * sign}, {0.03 * sign}]
"""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "boxes.toml"
        scene.write_text(f"dim = 2\n{body('a', (0.0, 0.0), 1)}{body('b', (1.02, 0.23), -1)}"
                         f"[contact]\nfriction = 0.6\n[run]\nsteps = {500 * across // 3}\n[output]\nframes = 0\ninterval = 1\n")
        return Run(programs, scene).require_end()


@claim
def flow_that_gives_energy_back_in_coarse_boxes_is_warned_of_and_finer_ones_give_none(programs):
    """All that flow dissipates, faces included, never falls in a step of boxes of twelve cells across."""
    for across, falls in ((3, True), (12, False)):
        run = collision(programs, across)
        flow = [row["dissipated_in_cells"] + row["dissipated_in_jumps"] + row["dissipated_on_faces"] for row in run.rows()]
        require((min(after - before for before, after in zip(flow, flow[1:])) < 0) == falls, f"{across} across: that it falls should be {falls}")
        require(run.warns_of("plastic flow gave energy back") == falls, f"{across} across: {run.said}")


def tell_table(folder):
    for shape, counts in TABLE.items():
        for across in counts:
            ratio, share = figures_of(pressed_block(folder, shape, across), 3 if shape in SPACE else 2)
            print(f"| {shape} | {across} | {ratio:.3f} | {share:.3f} |", flush=True)


if __name__ == "__main__":
    if sys.argv[2:] == ["--table"]:
        tell_table(pathlib.Path(sys.argv[1]))
    else:
        sys.exit(main(claim))
