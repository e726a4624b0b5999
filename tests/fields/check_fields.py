#!/usr/bin/env python3
"""Stresses where people look first: at faces that touch, and at holes.

    check_fields.py build/dev/bin --list
    check_fields.py build/dev/bin blocks_that_planes_press_show_the_stress_in_each_cell_that_touches
"""
import math
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
from abut_meshes import ring  # noqa: E402
from abut_runs import Claims, Run, main, near, require  # noqa: E402

claim = Claims()


# A block between two planes ----------------------------------------------------------------------------------------------

STRETCH = 0.99
# E = 1 Pa, nu = 0, side 1: force and stress [N/m], [Pa]. St. Venant and Kirchhoff's law has S = E (l^2 - 1)/2 and the force l S; the
# sides stay as they are, so that this is the stress, too.
EXACT = {"finite": -STRETCH * (STRETCH**2 - 1) / 2, "floating": 1 - STRETCH, "small": 1 - STRETCH}
KINEMATICS = list(EXACT)


def table_of_pressed_blocks():
    """{(cells, across): force over the exact one, by kinematics} as docs/kinematics.md has it."""
    text = (HERE.parent.parent / "docs/kinematics.md").read_text().partition("### Pressed blocks")[2].partition("\n### ")[0]
    rows = re.findall(r"^\| (\w+) \| (\d+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", text, re.M)
    require(len(rows) > 20, "the table of pressed blocks is not read")
    return {(shape, int(across)): dict(zip(KINEMATICS, map(float, ratios))) for shape, across, *ratios in rows}


def pressed_block(programs, shape, across, kinematics, layer=None, heated=0.0):
    """The last force on the press. With `layer` the stresses along it of a layer of cells in the plane, too; 0: that which it touches.
    `heated`: the block is, by this strain, and the press stands still."""
    dim = 3 if shape in ("hexahedron", "tetrahedron") else 2
    vector = lambda first, rest: "[" + ", ".join([first] + [rest] * (dim - 1)) + "]"
    shortened = 0 if heated else 1 - STRETCH
    heat = f'thermal_expansion = 1.0\ntemperature_rise = "{heated}*min(t/20, 1)"\n' if heated else ""
    cells = [] if layer is None else range(across)
    probes = "".join(f'[output.probes.cell_{i}]\nbody = "block"\npoint = [{1 - (layer + 0.5) / across}, {(i + 0.5) / across}]\n'
                     for i in cells)
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "block.toml"
        scene.write_text(f"""dim = {dim}
energy_scale = 1e-5
[bodies.block]
shape = "structured_box"
lower = {vector("0", "0")}
upper = {vector("1", "1")}
counts = {vector(str(across), str(across))}
cells = "{shape}"
young = 1.0
poisson = 0.0
density = 1.0
mass_damping = 0.5
kinematics = "{kinematics}"
{heat}[obstacles.wall]
shape = "plane"
point = {vector("0", "0")}
normal = {vector("1", "0")}
[obstacles.press]
shape = "plane"
point = {vector("1", "0")}
normal = {vector("-1", "0")}
path = {vector(f'"-{shortened:g}*min(t/20, 1)"', "0")}
[run]
time = 45.0
[output]
frames = 0
forces = true
interval = 49
{probes}""")
        done = Run(programs, scene, seconds=None if dim == 3 else 240).require_end()
        force = [row["normal_force"] for row in done.rows("forces.csv") if "press" in (row["body_1"], row["body_2"])][-1]
        if layer is None:
            return force
        last = done.rows("probes.csv")[-1]
        return force, [-last[f"cell_{i}.stress_xx"] for i in cells]


@claim
def finite_blocks_that_planes_press_bear_their_force_and_the_page_says_how_nearly(programs):
    """Within 5 % with four cells across and 0.5 % with eight; docs/kinematics.md has what they bear, as it is rounded."""
    table = table_of_pressed_blocks()
    for shape, across, allowed in (("quadrangle", 4, 0.05), ("quadrangle", 8, 0.005), ("triangle", 8, 0.005)):
        ratio = pressed_block(programs, shape, across, "finite") / EXACT["finite"]
        near(ratio, 1.0, allowed, f"the force on {across} {shape}s across over the exact one")
        near(ratio, table[shape, across]["finite"], 6e-4, f"the page on {across} {shape}s across")


@claim
def a_section_of_a_finite_block_carries_the_force_that_presses_it(programs):
    """Within 1 %, in the middle of eight cells: stresses are in balance with what is borne."""
    force, stresses = pressed_block(programs, "quadrangle", 8, "finite", layer=3)
    near(sum(stresses) / len(stresses) / force, 1.0, 0.01, "the mean stress of a section of side 1 over the force")


@claim
def blocks_that_planes_press_show_the_stress_in_each_cell_that_touches(programs):
    """Within 1 % where eight cells are across, corners included; finite ones show what they bear."""
    for kinematics in KINEMATICS:
        force, stresses = pressed_block(programs, "quadrangle", 8, kinematics, layer=0)
        near(force / EXACT[kinematics], 1.0, 0.005 if kinematics == "finite" else 1e-3, f"{kinematics}: the force over the exact one")
        for stress in stresses:
            near(stress / EXACT[kinematics], 1.0, 0.01, f"{kinematics}: a stress over the exact one")


@claim
def heated_blocks_between_planes_press_with_the_force_of_the_heat_that_they_cannot_follow(programs):
    """A stretch l by heat that is taken back: E (l^-2 - 1)/2 over a side that has grown by l, in finite blocks of eight cells."""
    stretch = 2 - STRETCH
    force, stresses = pressed_block(programs, "quadrangle", 8, "finite", layer=0, heated=stretch - 1)
    stress = (1 - stretch**-2) / 2
    near(force / (stress * stretch), 1.0, 0.005, "the force over the exact one")
    for of_cell in stresses:
        near(of_cell / stress, 1.0, 0.01, "a stress over the exact one")


# A block under loads that vary -------------------------------------------------------------------------------------------

SMALL = 1e-4  # load over Young's modulus
DEPTH = "(1 - y)"  # a liquid of weight SMALL per area stands from y = 1 down, and the block of side 1 from 1/2 to -1/2
LOADS = {"bend": {"xmin": f'value = ["-{SMALL}*y", 0]', "xmax": f'value = ["{SMALL}*y", 0]'},
         "dive": {side: f'pressure = "{SMALL}*{DEPTH}"' for side in ("xmin", "xmax", "ymin", "ymax")}}
# Largest stress: half of the side, or all of the depth.
LARGEST = {"bend": 0.5, "dive": 1.5}


def loaded_block(programs, shape, across, kinematics, load, follows=False):
    """{(i, j): sigma_xx, sigma_yy, sigma_xy in cell (i, j)} over the load at y = 1, at rest under loads in balance. Dead loads and those
    of a diving block leave how it is turned to chance: soft springs that nothing pulls hold it."""
    place = lambda i: (i + 0.5) / across
    cells = [(i, j) for i in range(across) for j in range(across)]
    tractions = "".join(f'[tractions.{side}]\ngroup = "block.{side}"\n{value}\n' + ("follows = true\n" if follows else "")
                        for side, value in LOADS[load].items())
    springs = "".join(f'[springs.at_{x}]\nfrom = {{body = "block", point = [0.{x}, 0]}}\nto = {{point = [0.{x}, 0]}}\n'
                      "stiffness = 3e-4\nlength = 0\n" for x in (25, 75)) if kinematics == "finite" else ""
    probes = "".join(f'[output.probes.cell_{i}_{j}]\nbody = "block"\npoint = [{place(i)}, {place(j) - 0.5}]\n' for i, j in cells)
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "block.toml"
        scene.write_text(f"""dim = 2
energy_scale = 1e-8
gravity = [0, {-SMALL if load == "dive" else 0}]
[bodies.block]
shape = "structured_box"
lower = [0, -0.5]
upper = [1, 0.5]
counts = [{across}, {across}]
cells = "{shape}"
young = 1.0
poisson = 0.3
density = 1.0
kinematics = "{kinematics}"
{tractions}{springs}[run]
steps = 1
settle = true
[output]
frames = 0
{probes}""")
        last = Run(programs, scene).require_end().rows("probes.csv")[-1]
        return {(i, j): [last[f"cell_{i}_{j}.stress_{part}"] / SMALL for part in ("xx", "yy", "xy")] for i, j in cells}


def largest_error(programs, shape, across, kinematics, load, follows=False):
    """Of all stresses of quadrangles, over the largest one. The exact field is sigma_xx = y, or sigma_xx = sigma_yy = -(1 - y)."""
    error = 0.0
    for (_, j), found in loaded_block(programs, shape, across, kinematics, load, follows).items():
        y = (j + 0.5) / across - 0.5
        exact = (y, 0, 0) if load == "bend" else (y - 1, y - 1, 0)
        error = max(error, *(abs(a - b) for a, b in zip(found, exact)))
    return error / LARGEST[load]


@claim
def cells_behind_loads_that_turn_with_the_body_have_the_traction_of_the_middle_of_their_face(programs):
    """In small and floating blocks, exactly: half a cell away from where the cell has its middle."""
    for kinematics in ("small", "floating"):
        for load, top, side in (("bend", lambda y: None, lambda y: y), ("dive", lambda y: -0.5, lambda y: y - 1)):
            across = 6
            stress = loaded_block(programs, "quadrangle", across, kinematics, load, follows=load == "bend" and kinematics == "floating")
            for k in range(across):
                y = (k + 0.5) / across - 0.5
                near(stress[0, k][0], side(y), 1e-6, f"{kinematics}, {load}: sigma_xx at the left side")
                if top(y) is not None:
                    near(stress[k, across - 1][1], top(y), 1e-6, f"{kinematics}, {load}: sigma_yy at the top")


@claim
def loads_that_vary_give_stress_of_first_order_and_the_page_says_how_nearly(programs):
    """docs/kinematics.md has the largest errors with 8 and 16 cells across; they fall by half, or faster."""
    text = (HERE.parent.parent / "docs/kinematics.md").read_text().partition("### Loads that vary")[2].partition("\n### ")[0]
    rows = re.findall(r"^\| (bend|dive), (\w+) \| (\w+)(, follows)? \| ([\d.]+) \| ([\d.]+) \|$", text, re.M)
    require(len(rows) == 6, "the table of loads that vary is not read")
    for load, shape, kinematics, follows, *said in rows:
        found = [largest_error(programs, shape, across, kinematics, load, bool(follows)) for across in (8, 16)]
        require(found[1] < 0.55 * found[0], f"{load}, {shape}, {kinematics}: {found} do not fall by half")
        for error, of_page in zip(found, map(float, said)):
            near(error, of_page, 6e-4, f"the page on {load}, {shape}, {kinematics}")


# A ring with a hole ------------------------------------------------------------------------------------------------------

BORE, RIM, PRESSURE = 0.5, 1.0, 0.01


def compare_ranks(programs, scene, ranks, what):
    """Energies and frames of several ranks against those of one."""
    one = Run(programs, scene, "--ranks", 1).require_end()
    require(one.summary["active_pairs_max"] > 0, f"{what} does not touch")
    expected = frames_of(one)
    require(len(expected) >= 4, f"{what}: there are no frames")
    shared = Run(programs, scene, "--ranks", ranks).require_end()
    require((shared.out / "energy.csv").read_bytes() == (one.out / "energy.csv").read_bytes(), f"{what}: energies have other bits")
    require(frames_of(shared) == expected, f"{what}: fields have other bits")


def frames_of(done):
    return {path.name: path.read_bytes() for path in (done.out / "frames").iterdir() if path.suffix in (".vtu", ".vtp")}


@claim
def fields_of_a_ring_with_a_hole_are_bitwise_identical_on_ranks(programs):
    """Pressed in its hole against a plane: a quarter on rollers, and whole rings whose cells hollows condense."""
    rollers = "".join(f'[supports.{group}]\ngroup = "ring.{group}"\nconstraint = "normal"\n' for group in ("foot", "side"))
    for kinematics, angle, around, more in (("small", 0.5 * math.pi, 10, rollers), ("floating", 2 * math.pi, 24, ""),
                                            ("finite", 2 * math.pi, 24, "")):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "ring.toml"
            ring(pathlib.Path(folder) / "ring.msh", "ring", ("hole", "rim", *(("foot", "side") if more else ())), BORE, RIM, 4, around,
                 angle=angle)
            scene.write_text(f"""dim = 2
energy_scale = 1e-4
[bodies.ring]
mesh = "ring.msh"
young = 1
poisson = 0.3
density = 1
kinematics = "{kinematics}"
[tractions.hole]
group = "ring.hole"
pressure = {PRESSURE}
[obstacles.wall]
shape = "plane"
point = [{RIM + 1e-3}, 0]
normal = [-1, 0]
[run]
time = 3
[output]
frames = 4
{more}""")
            compare_ranks(programs, scene, 2, f"the {kinematics} ring")


@claim
def finite_blocks_pressed_at_edges_and_corners_are_bitwise_identical_on_ranks_at_given_times(programs):
    """In space, where faces of cells at edges and corners touch; the times lie inside of steps and at their ends."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "block.toml"
        scene.write_text("""dim = 3
energy_scale = 1e-5
[bodies.block]
shape = "structured_box"
lower = [0, 0, 0]
upper = [1, 1, 1]
counts = [4, 4, 4]
young = 1
poisson = 0.3
density = 1
kinematics = "finite"
[obstacles.wall]
shape = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
[obstacles.press]
shape = "plane"
point = [1, 0, 0]
normal = [-1, 0, 0]
path = ["-0.01*min(t/2, 1)", 0, 0]
[run]
time = 3
[output]
times = [0.5, 1.2345, 3]
""")
        compare_ranks(programs, scene, 3, "the block")



if __name__ == "__main__":
    sys.exit(main(claim))
