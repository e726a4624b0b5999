#!/usr/bin/env python3
"""A scene that is turned, mirrored, shifted or numbered in another way is the same scene: each claim by runs of `abut run`.

    check_images.py build/dev/bin --list
    check_images.py build/dev/bin springs_on_fans

A dozen scenes, each with a mesh file of its own. What a run of an image must show is that of the scene itself, turned and mirrored
likewise: displacements and velocities of all bodies, and energies. They differ by rounding, which grows where bodies bounce.
"""
import json
import math
import pathlib
import random
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import abut_meshes  # noqa: E402
import abut_runs  # noqa: E402
from abut_runs import Claims, main, require  # noqa: E402

claim = Claims()
ALLOWED = 1e-9  # of the largest value in the run; rounding makes 1e-16 of it, and bounces let that grow


class Image:
    """Turned by quarters, then mirrored (x to -x), then shifted; `seed`: nodes and cells are numbered anew."""

    def __init__(self, quarters=0, mirrored=False, shift=(0, 0), seed=None):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters]
        self.rows = [(-c, s) if mirrored else (c, -s), (s, c)]
        self.mirrored, self.shift, self.seed = mirrored, shift, seed
        self.name = f"{quarters} quarters{', mirrored' if mirrored else ''}, shifted by {shift}{', renumbered' if seed else ''}"

    def vector(self, v):
        """Of numbers or formulas; every row has one entry that is not 0."""
        of_row = lambda row: (v[0], row[0]) if row[0] else (v[1], row[1])
        return [(f"-({x})" if isinstance(x, str) else -x) if sign < 0 else x for x, sign in map(of_row, self.rows)]

    def back(self, v):
        return [sum(self.rows[i][j] * v[i] for i in range(2)) for j in range(2)]

    def point(self, p):
        return [x + by for x, by in zip(self.vector(p), self.shift)]

    def spin(self, w):
        return -w if self.mirrored else w


IMAGES = [Image(1), Image(2), Image(mirrored=True), Image(3, mirrored=True), Image(shift=(12.3, -7.1)), Image(seed=1),
          Image(1, True, (-3.7, 41.9), seed=2)]


# Meshes -------------------------------------------------------------------------------------------------------------

def block(lower, upper, counts, triangles=False, uneven=0.0):
    """Nodes, cells and sides of a rectangle; `uneven`: part of a cell by which its inner nodes lie elsewhere."""
    nx, ny = counts
    size = [(upper[d] - lower[d]) / counts[d] for d in range(2)]
    at = lambda i, j: (nx + 1) * j + i
    places = random.Random(7)
    nodes = []
    for j in range(ny + 1):
        for i in range(nx + 1):
            off = [uneven * places.uniform(-1, 1) for _ in range(2)] if 0 < i < nx and 0 < j < ny else (0, 0)
            nodes.append((lower[0] + size[0] * (i + off[0]), lower[1] + size[1] * (j + off[1])))
    cells = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(ny) for i in range(nx)]
    if triangles:
        cells = [part for a, b, c, d in cells for part in ((a, b, c), (a, c, d))]
    sides = {"left": [(at(0, j), at(0, j + 1)) for j in range(ny)], "right": [(at(nx, j), at(nx, j + 1)) for j in range(ny)],
             "below": [(at(i, 0), at(i + 1, 0)) for i in range(nx)], "above": [(at(i, ny), at(i + 1, ny)) for i in range(nx)]}
    return nodes, cells, sides


def fan(centre, radius, sectors):
    """Triangles about a centre, all at one distance from it."""
    rim = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a))
           for a in (2 * math.pi * i / sectors for i in range(sectors))]
    return [centre, *rim], [(0, 1 + i, 1 + (i + 1) % sectors) for i in range(sectors)], {}


def write_mesh(path, mesh, name, image):
    nodes, cells, sides = mesh
    order = list(range(len(nodes)))
    cells = [tuple(reversed(cell)) if image.mirrored else cell for cell in cells]
    elements = [(1, side, edge) for side, edges in sides.items() for edge in edges]
    if image.seed:
        shuffled = random.Random(image.seed)
        shuffled.shuffle(order)
        shuffled.shuffle(cells)
        shuffled.shuffle(elements)
    new = {old: i for i, old in enumerate(order)}
    renumbered = lambda corners: tuple(new[c] for c in corners)
    abut_meshes.write_msh(path, [image.point(nodes[old]) for old in order],
                          [(dim, side, renumbered(edge)) for dim, side, edge in elements] +
                          [(2, name, renumbered(cell)) for cell in cells])


# Scenes -------------------------------------------------------------------------------------------------------------

SOFT = {"young": 1.0, "poisson": 0.3, "density": 1.0, "kinematics": "floating"}


class Scene:
    """`bodies`: name -> (mesh, keys); `tables`: made by a function of the image; `dt`: a step that is stable for all of them."""

    def __init__(self, bodies, tables=lambda image: {}, steps=200, dt=0.01, run=None):
        self.bodies, self.tables, self.steps, self.dt, self.run = bodies, tables, steps, dt, run or {}

    def write(self, folder, image):
        text = ["dim = 2", "energy_scale = 1e-3"]
        tables = {"run": {"steps": self.steps, "dt": self.dt, "threads": 1, **self.run}, "output": {"frames": 0, "interval": 10}}
        for name, (mesh, keys) in self.bodies.items():
            write_mesh(folder / f"{name}.msh", mesh, name, image)
            keys = {**SOFT, **keys, "mesh": f"{name}.msh"}
            for key in ("velocity",):
                if key in keys:
                    keys[key] = image.vector(keys[key])
            if "spin" in keys:
                keys["spin"] = image.spin(keys["spin"])
            tables[f"bodies.{name}"] = keys
            tables[f"output.probes.{name}"] = {"body": name}
        for name, keys in self.tables(image).items():
            if not isinstance(keys, dict):
                text.append(f"{name} = {value_of(keys)}")
            else:
                tables[name] = keys
        for name, keys in tables.items():
            text += [f"[[{name[:-2]}]]" if name.endswith("[]") else f"[{name}]"]
            text += [f"{key} = {value_of(value)}" for key, value in keys.items()]
        path = folder / "scene.toml"
        path.write_text("\n".join(text) + "\n")
        return path


def value_of(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {value_of(one)}" for key, one in value.items()) + "}"
    return json.dumps(value)


def results(programs, scene, image):
    """Columns of a run as they would be without the image: energies, and the vectors of probes."""
    with tempfile.TemporaryDirectory() as folder:
        path = scene.write(pathlib.Path(folder), image)
        done = abut_runs.Run(programs, path).require_end()
        columns = {key: [row[key] for row in done.rows()] for key in ("kinetic", "potential", "dissipated", "work")}
        rows = done.rows("probes.csv")
        for name in scene.bodies:
            for vector in ("displacement", "velocity"):
                pairs = [image.back([row[f"{name}.{vector}_{axis}"] for axis in "xy"]) for row in rows]
                columns[f"{name}.{vector}"] = [x for pair in pairs for x in pair]
        return columns


def same_in_all_images(programs, scene, allowed=ALLOWED, images=IMAGES):
    own = results(programs, scene, Image())
    require(max(abs(x) for name, column in own.items() for x in column if "displacement" in name) > 1e-4, "nothing moves")
    energy = max(abs(x) for name in ("kinetic", "potential", "work") for x in own[name])
    for image in images:
        for name, column in results(programs, scene, image).items():
            size = energy if "." not in name else max(map(abs, own[name]))
            off = max(abs(a - b) for a, b in zip(column, own[name])) / size
            require(off <= allowed, f"{image.name}: {name} is off by {off:.2g} of its size")


@claim
def springs_on_fans(programs):
    """All cells of a fan are as far from its centre: all of them hold the spring."""
    def tables(image):
        return {"contact": {"enabled": False},
                "springs.s": {"from": {"body": "a", "point": image.point([0, 0]), "radius": 0.1},
                              "to": {"body": "b", "point": image.point([0.2, 1]), "radius": 0.1}, "stiffness": 0.05}}
    same_in_all_images(programs, Scene({"a": (fan((0, 0), 0.3, 12), {"velocity": [0, -0.01], "spin": 0.02}),
                                        "b": (fan((0.2, 1), 0.3, 16), {"velocity": [0, 0.01]})}, tables, steps=1000, dt=0.02),
                       images=[image for image in IMAGES if not image.seed])  # stencils of a fan have ties that numbers decide


@claim
def a_spring_to_the_ground_on_a_block_of_squares(programs):
    """Four squares are as far from the node where the spring is held."""
    def tables(image):
        return {"springs.s": {"from": {"body": "a", "point": image.point([0.4, 0.4])},
                              "to": {"point": image.point([0.4, 1.5])}, "stiffness": 0.1, "length": 0.8}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 1), (5, 5)), {"spin": 0.1})}, tables, dt=0.02, steps=500))


@claim
def a_moment_on_a_body_that_turns(programs):
    def tables(image):
        return {"moments.m": {"body": "a", "value": image.spin(0.002)}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), {"velocity": [0.01, 0], "spin": 0.05})},
                                       tables, steps=400))


@claim
def a_block_that_slides_and_stops(programs):
    def tables(image):
        return {"gravity": image.vector([0, -0.01]), "contact": {"friction": 0.3},
                "obstacles.floor": {"shape": "plane", "point": image.point([0, 0]), "normal": image.vector([0, 1])}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), {"velocity": [0.02, 0]})}, tables,
                                       steps=600), allowed=1e-7)


@claim
def two_bodies_that_meet_with_friction(programs):
    tables = lambda image: {"contact": {"friction": 0.2}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), {"velocity": [0.05, 0]}),
                                        "b": (block((1.0123, 0.13), (1.9, 0.71), (7, 5), uneven=0.2), {"velocity": [-0.05, 0.03]})},
                                       tables, steps=400), allowed=1e-8)


@claim
def two_bodies_under_the_reconstruction(programs):
    tables = lambda image: {"contact": {"law": "reconstruction"}}
    small = {"kinematics": "small"}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), {"velocity": [0.05, 0], **small}),
                                        "b": (block((1.0123, 0.13), (1.9, 0.71), (7, 5), uneven=0.2), {"velocity": [-0.05, 0], **small})},
                                       tables, steps=400), allowed=1e-8)


@claim
def a_rigid_block_that_tumbles(programs):
    def tables(image):
        return {"gravity": image.vector([0, -0.1]),
                "obstacles.floor": {"shape": "plane", "point": image.point([0, -0.1]), "normal": image.vector([0, 1]), "half_width": 5.0}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4)), {"kinematics": "rigid", "spin": 0.3})}, tables, steps=600),
                       allowed=1e-7)


@claim
def a_finite_body_under_a_following_pressure(programs):
    def tables(image):
        return {"supports.s": {"group": "a.left"}, "tractions.t": {"group": "a.above", "pressure": "0.002*min(t, 1)"}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (2, 0.5), (12, 4), uneven=0.2), {"kinematics": "finite"})}, tables, steps=400))


@claim
def metal_that_is_pulled(programs):
    def tables(image):
        return {"supports.s": {"group": "a.left", "constraint": "normal"},
                "tractions.t": {"group": "a.right", "value": image.vector(["0.004*min(t, 1)", "0.001"])}}
    metal = {"kinematics": "small", "law": "j2", "yield_stress": 0.002, "hardening": 0.1}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), triangles=True, uneven=0.2), metal)}, tables, steps=400))


@claim
def bodies_that_are_bonded(programs):
    def tables(image):
        return {"bonds[]": {"bodies": ["a", "b"]}, "contact": {"enabled": False},
                "tractions.t": {"group": "b.right", "value": image.vector([0.001, 0.002])}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), {}),
                                        "b": (block((1, 0), (2, 0.5), (7, 5), uneven=0.2), {})}, tables, steps=400))


@claim
def a_body_that_is_damped(programs):
    damped = {"mass_damping": 0.1, "stiffness_damping": 0.01, "velocity": [0.03, 0.02], "spin": 0.2}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), damped)}, steps=400, dt=0.005))


@claim
def a_body_that_is_heated(programs):
    warm = {"kinematics": "small", "thermal_expansion": 0.001, "temperature_rise": "10*min(t, 1)"}
    tables = lambda image: {"supports.s": {"group": "a.left"}}
    same_in_all_images(programs, Scene({"a": (block((0, 0), (1, 0.5), (8, 4), uneven=0.2), warm)}, tables, steps=300))


@claim
def the_step_of_a_rigid_body_that_is_turned(programs):
    """Whatever way a box and a disc look, their stable step is the same."""
    steps = []
    for angle in (0, 20, 45, 90, 137):
        text = f"""
dim = 2
energy_scale = 1.0
[bodies.a]
shape = "structured_box"
lower = [0, 0]
upper = [1, 0.25]
counts = [8, 2]
young = 1.0
poisson = 0.3
density = 1.0
velocity = [0.1, 0]
kinematics = "rigid"
turn = {math.radians(angle)}
[obstacles.floor]
shape = "plane"
point = [0, -2]
normal = [0, 1]
[run]
steps = 1
[output]
frames = 0
"""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.toml"
            path.write_text(text)
            steps.append(abut_runs.Run(programs, path).require_end().summary["dt"])
    require(max(steps) / min(steps) - 1 <= 1e-9, f"steps are {steps}")


if __name__ == "__main__":
    sys.exit(main(claim))
