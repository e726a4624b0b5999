#!/usr/bin/env python3
"""Quarter and half models on rollers beside whole ones, and both beside closed forms: holes, rollers and rings that are pressed on.

    check_quarters.py build/dev/bin --list

Needs python3-vtk9; exits with 77 where it is missing.
"""
import itertools
import math
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
try:
    import numpy
    from abut_frames import last_cells, last_faces
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)
from abut_meshes import write_msh  # noqa: E402
from abut_runs import Run, main, near, require  # noqa: E402

CLAIMS = {}


def claim(function):
    CLAIMS[function.__name__] = function
    return function


def graded(first, last, count, step):
    """`count` + 1 numbers from `first` to `last` whose steps grow by a constant ratio, from `step` on."""
    low, high = 1 + 1e-9, 10.0
    for _ in range(100):
        ratio = (low + high) / 2
        low, high = (low, ratio) if step * (ratio**count - 1) / (ratio - 1) > last - first else (ratio, high)
    return [first + step * (ratio**i - 1) / (ratio - 1) for i in range(count)] + [last]


class Part:
    """A grid of cells with x, y >= 0, and its images behind the planes x = 0 and y = 0 as far as `images` names them.

    `grid[i][k]`: corners. `sides`: names of the faces with the least i, the largest i, the least k and the largest k. Those named "foot"
    (y = 0) and "side" (x = 0) lie on planes, and are faces only where the body ends there."""

    def __init__(self, grid, shape, sides, images):
        self.grid, self.sides, self.images = numpy.array(grid), sides, images
        self.cuts = [(0, 1, 2, 3)] if shape == "quadrangle" else [(0, 1, 2), (0, 2, 3)]

    def quads(self):
        rows, columns = self.grid.shape[0] - 1, self.grid.shape[1] - 1
        return [((i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1)) for i in range(rows) for k in range(columns)]

    def edges(self):
        rows, columns = self.grid.shape[0] - 1, self.grid.shape[1] - 1
        ends = [[((i, k), (i, k + 1)) for k in range(columns)] for i in (0, rows)]
        ends += [[((i, k), (i + 1, k)) for i in range(rows)] for k in (0, columns)]
        inside = [name for name, axis in (("foot", 1), ("side", 0)) if any(image[axis] < 0 for image in self.images)]
        return [(name, edge) for name, edges in zip(self.sides, ends) if name not in inside for edge in edges]

    def write(self, path):
        nodes, elements = {}, []

        def node(image, corner):
            point = tuple(float(x) + 0.0 for x in self.grid[corner] * image)
            return nodes.setdefault(tuple(round(x, 12) + 0.0 for x in point), len(nodes))

        for image in self.images:
            for quad in self.quads():
                for cut in self.cuts:
                    corners = [node(image, quad[c]) for c in cut]
                    elements.append((2, path.stem, corners if image[0] * image[1] > 0 else corners[::-1]))
            elements += [(1, name, [node(image, corner) for corner in edge]) for name, edge in self.edges()]
        write_msh(path, list(nodes), elements)

    def centres(self):
        """(n_quads, n_cuts, 2)"""
        return numpy.array([[numpy.mean([self.grid[quad[c]] for c in cut], axis=0) for cut in self.cuts] for quad in self.quads()])

    def folded(self, fields, name, body=0):
        """Values of a body, (n_images, rows, columns, n), means over the cells of a quadrangle."""
        mine = fields["body"] == body
        points, values = fields.centres[mine, :2], fields[name][mine].reshape(mine.sum(), -1)
        places = self.centres().reshape(-1, 2)
        index = numpy.argmin(((numpy.abs(points)[:, None] - places) ** 2).sum(axis=2), axis=1) // len(self.cuts)
        result = numpy.zeros((len(self.images), len(places) // len(self.cuts), values.shape[1]))
        for at, image in enumerate(self.images):
            there = (points * image > 0).all(axis=1)
            numpy.add.at(result[at], index[there], values[there] / len(self.cuts))
        return result.reshape(len(self.images), self.grid.shape[0] - 1, self.grid.shape[1] - 1, -1)

    def middles(self):
        """(rows, columns, 2)"""
        return self.centres().mean(axis=1).reshape(self.grid.shape[0] - 1, self.grid.shape[1] - 1, 2)

    def stress(self, fields, body=0):
        """xx, yy and xy of each quadrangle as in the first image, (n_images, rows, columns, 3)."""
        stress = self.folded(fields, "stress", body)[..., [0, 1, 3]]
        for of_image, image in zip(stress, self.images):
            of_image[..., 2] *= image[0] * image[1]
        return stress


def each_image(stress):
    return stress


def mean_image(stress):
    """The mean over images (n_images, rows, columns, n), whose triangles differ."""
    return stress.mean(axis=0, keepdims=True)


QUARTER = [(1, 1)]
WHOLE = list(itertools.product((1, -1), (1, -1)))


def roller(body, group):
    return f'[supports.{body}_{group}]\ngroup = "{body}.{group}"\nconstraint = "normal"\n'


def rollers(body):
    return roller(body, "foot") + roller(body, "side")


def turned(stress, points):
    """Radial and hoop stress of xx, yy and xy at points."""
    angle = numpy.arctan2(points[..., 1], points[..., 0])
    c, s = numpy.cos(angle), numpy.sin(angle)
    xx, yy, xy = numpy.moveaxis(stress, -1, 0)
    return c * c * xx + s * s * yy + 2 * s * c * xy, s * s * xx + c * c * yy - 2 * s * c * xy


def at_rest(programs, part, scene):
    """Fields of the cells of a damped body under loads that stand from the start."""
    with tempfile.TemporaryDirectory() as folder:
        part.write(pathlib.Path(folder) / "plate.msh")
        file = pathlib.Path(folder) / "plate.toml"
        file.write_text(scene + "[run]\ntime = 100\n[output]\nframes = 2\n")
        return last_cells(Run(programs, file).require_end())


# A plate with a hole of radius 1 -----------------------------------------------------------------------------------------

# Kirsch, Z. Ver. dt. Ing. 42 (1898) 797: stress over the tension S along x that acts far away, as formulas of scenes.
R2 = "(x^2 + y^2)"
C2, S2 = f"((x^2 - y^2)/{R2})", f"(2*x*y/{R2})"
C4, S4 = f"({C2}^2 - {S2}^2)", f"(2*{S2}*{C2})"
KIRSCH = {"xx": f"(1 - (1.5*{C2} + {C4})/{R2} + 1.5*{C4}/{R2}^2)", "yy": f"(-(0.5*{C2} - {C4})/{R2} - 1.5*{C4}/{R2}^2)",
          "xy": f"(-(0.5*{S2} + {S4})/{R2} + 1.5*{S4}/{R2}^2)"}
LARGEST = 3.0  # of his stresses, at the hole
AROUND, LAYERS = 24, 18  # cells of a quarter


def kirsch(points):
    """xx, yy and xy (..., 3)"""
    x, y = points[..., 0], points[..., 1]
    return numpy.stack([eval(formula.replace("^", "**"), {"x": x, "y": y}) for formula in KIRSCH.values()], axis=-1)


def plate(shape, images, half_length=3.0, half_width=3.0, around=AROUND, layers=LAYERS):
    """Rays from the hole to the outside, one of them to its corner."""
    shares = [(r - 1) / (half_width - 1) for r in graded(1, half_width, layers, math.pi / 2 / around)]
    rays = [(math.cos(angle), math.sin(angle)) for angle in (math.pi / 2 * k / around for k in range(around))] + [(0.0, 1.0)]
    ends = [(x / max(x, y) * half_length, y / max(x, y) * half_width) for x, y in rays]
    grid = [[(x + share * (far_x - x), y + share * (far_y - y)) for (x, y), (far_x, far_y) in zip(rays, ends)] for share in shares]
    return Part(grid, shape, ("hole", "outside", "foot", "side"), images)


def pulled(programs, part, kinematics, value, tension):
    """Stress over S, (n_images, rows, columns, 3). `value`: the traction outside over S."""
    x, y = value
    return part.stress(at_rest(programs, part, f"""dim = 2
energy_scale = 1e-5
[bodies.plate]
mesh = "plate.msh"
young = 1
poisson = 0.3
density = 1
kinematics = "{kinematics}"
mass_damping = 0.25
[tractions.outside]
group = "plate.outside"
value = ["{tension}*({x})", "{tension}*({y})"]
{"" if len(part.images) > 1 else rollers("plate")}""")) / tension


def by_kirsch(programs, kinematics, shape, images, tension=1e-3, **cells):
    """A square of side 6 under the tractions that his plate without end has there."""
    x, y = "(abs(x) > 3 - 1e-9 ? x/3 : 0)", "(abs(y) > 3 - 1e-9 ? y/3 : 0)"
    return pulled(programs, plate(shape, images, **cells), kinematics,
                  [f"{x}*{KIRSCH['xx']} + {y}*{KIRSCH['xy']}", f"{x}*{KIRSCH['xy']} + {y}*{KIRSCH['yy']}"], tension)


@claim
def quarters_of_a_plate_with_a_hole_have_the_hoop_stress_of_kirsch(programs):
    """Within 2 % of the largest one, at the hole and away from it; where it is largest, and behind it, within 2.5 % of itself."""
    for shape in ("quadrangle", "triangle"):
        part = plate(shape, QUARTER)
        hoop = turned(by_kirsch(programs, "small", shape, QUARTER)[0], part.middles())[1]
        exact = turned(kirsch(part.middles()), part.middles())[1]
        near(numpy.abs(hoop - exact).max() / LARGEST, 0, 0.02, f"{shape}s: the error of the hoop stress of a cell over the largest one")
        for layer, ratio in enumerate(hoop[:, -1] / exact[:, -1]):
            near(ratio, 1, 0.025, f"{shape}s: layer {layer} above the hole: the hoop stress over Kirsch's")


def compare_plates(programs, shape, of_images):
    quarter = by_kirsch(programs, "small", shape, QUARTER)[0, ..., :2]
    for kinematics in ("small", "floating"):
        whole = of_images(by_kirsch(programs, kinematics, shape, WHOLE)[..., :2])
        near(numpy.abs(whole - quarter).max() / LARGEST, 0, 0.01, f"{kinematics}: the difference of stresses over the largest one")


@claim
def quarters_of_a_plate_of_quadrangles_with_a_hole_have_the_stress_of_whole_plates(programs):
    """Along x and y, of each image, within 1 % of the largest stress."""
    compare_plates(programs, "quadrangle", of_images=each_image)


@claim
def quarters_of_a_plate_of_triangles_with_a_hole_have_the_stress_of_whole_plates(programs):
    """Along x and y, in the mean of the images, within 1 % of the largest stress."""
    compare_plates(programs, "triangle", of_images=mean_image)


@claim
def finite_plates_with_a_hole_have_the_stress_of_small_ones(programs):
    """At strains of 1e-4, within 1 % of the largest one in each cell, and within 0.1 % at the hole."""
    small, finite = (by_kirsch(programs, kinematics, "quadrangle", WHOLE, tension=1e-4, around=12, layers=10)
                     for kinematics in ("small", "finite"))
    off = numpy.abs(finite - small).max(axis=(0, 2, 3)) / LARGEST
    near(off.max(), 0, 0.01, "the difference over the largest stress")
    near(off[0], 0, 0.001, "the difference at the hole over the largest stress")


@claim
def strips_with_a_hole_have_the_stress_concentration_of_their_width(programs):
    """Within 2 % of 3: (2 + (1 - d/w)^3)/(1 - d/w) of the tension, d/w = 1/6 here (Heywood, Designing by Photoelasticity, 1952). It
    is taken as 3 times the stress over Kirsch's in the cell where that is largest."""
    narrow = 1 - 1 / 6
    for shape in ("quadrangle", "triangle"):
        part = plate(shape, QUARTER, half_length=12.0, half_width=6.0)
        stress = pulled(programs, part, "small", ("x > 12 - 1e-9 ? 1 : 0", "0"), 1e-3)[0]
        ratio = stress[0, -1, 0] / kirsch(part.middles())[0, -1, 0]
        near(LARGEST * ratio, (2 + narrow**3) / narrow, 0.02 * LARGEST, f"{shape}s: the stress concentration")


# A roller on a rigid plane -----------------------------------------------------------------------------------------------

# Hertz's pressure p sqrt(1 - x^2) on the surface of a half plane, y into it, and McEwen's stresses under it over p (Johnson, Contact
# Mechanics (1985), section 4.2), as formulas of scenes. The half width of the contact is 1.
RADIUS, POISSON = 1000.0, 0.3
PEAK = 1 / (1 - POISSON**2) / (2 * RADIUS)  # [Pa], E = 1 Pa
D, Q = "(1 - x^2 + y^2)", "sqrt((1 - x^2 + y^2)^2 + 4*x^2*y^2)"
M2, N2 = f"(({Q} + {D})/2)", f"max(0, ({Q} - {D})/2)"
UNDER = {"xx": f"(2*y - sqrt({M2})*(1 + (y^2 + {N2})/({M2} + {N2})))", "yy": f"(-sqrt({M2})*(1 - (y^2 + {N2})/({M2} + {N2})))",
         "xy": f"(-sign(x)*sqrt({N2})*({M2} - y^2)/({M2} + {N2}))"}
RIGHT, BOTH = [(1, 1)], [(1, 1), (-1, 1)]


def under_hertz(points):
    """xx, yy and xy over p (..., 3)"""
    names = {"x": points[..., 0], "y": points[..., 1], "sqrt": numpy.sqrt, "max": numpy.maximum, "sign": numpy.sign}
    return numpy.stack([eval(formula.replace("^", "**"), names) for formula in UNDER.values()], axis=-1)


class Roller:
    """2 wide to each side and 2 high, on a plane, at rest under the tractions that stand there in a half plane."""

    def __init__(self, programs, kinematics, shape, images, per_half_width=14):
        steps = [i / per_half_width for i in range(2 * per_half_width + 1)]
        grid = [[(x, bottom + y / 2 * (2 - bottom)) for y in steps] for x, bottom in ((x, x * x / (2 * RADIUS)) for x in steps)]
        self.part = Part(grid, shape, ("side", "far", "bottom", "top"), images)
        with tempfile.TemporaryDirectory() as folder:
            self.part.write(pathlib.Path(folder) / "roller.msh")
            scene = pathlib.Path(folder) / "roller.toml"
            scene.write_text(f"""dim = 2
energy_scale = 1e-5
[bodies.roller]
mesh = "roller.msh"
young = 1
poisson = {POISSON}
density = 1
kinematics = "{kinematics}"
mass_damping = 0.7
[tractions.top]
group = "roller.top"
value = ["{PEAK}*{UNDER["xy"]}", "{PEAK}*{UNDER["yy"]}"]
[tractions.far]
group = "roller.far"
value = ["{PEAK}*sign(x)*{UNDER["xx"]}", "{PEAK}*sign(x)*{UNDER["xy"]}"]
[obstacles.plane]
shape = "plane"
point = [0, 0]
normal = [0, 1]
{"" if len(images) > 1 else roller("roller", "side")}[run]
time = 60
[output]
frames = 2
""")
            done = Run(programs, scene).require_end()
            faces = last_faces(done)
            self.stress = self.part.stress(last_cells(done)) / PEAK
        bottom = faces["group: roller.bottom"] > 0
        self.places = faces.centres[bottom, 0]
        self.pressures = faces["contact pressure"][bottom] / PEAK

    def pressure(self, side):
        """Of the faces on a side, from the middle outwards."""
        there = self.places * side > 0
        return self.pressures[there][numpy.argsort(numpy.abs(self.places[there]))]


@claim
def halves_of_a_roller_have_the_pressure_of_hertz_and_the_stress_under_it(programs):
    """Pressure where it is largest and half width, by its mean square, within 1 %; stress along the axis within 2.5 % of the pressure."""
    for shape in ("quadrangle", "triangle"):
        half = Roller(programs, "small", shape, RIGHT)
        near(half.pressures.max(), 1, 0.01, f"{shape}s: the largest pressure over Hertz's")
        width = 2 * math.sqrt(numpy.average(half.places**2, weights=half.pressures))
        near(width, 1, 0.01, f"{shape}s: the half width over Hertz's")
        off = numpy.abs(half.stress[0] - under_hertz(half.part.middles()))[0, :, 1]
        near(off.max(), 0, 0.025, f"{shape}s: the error of the stress along the axis over the pressure")


def compare_rollers(programs, shape, of_images):
    half = Roller(programs, "small", shape, RIGHT)
    for kinematics in ("small", "floating"):
        whole = Roller(programs, kinematics, shape, BOTH)
        off = max(numpy.abs(whole.pressure(side) - half.pressure(1)).max() for side in (1, -1))
        near(off, 0, 0.01, f"{kinematics}: the difference of pressures over the largest one")
        off = numpy.abs(of_images(whole.stress) - half.stress)[..., :2].max()
        near(off, 0, 0.01, f"{kinematics}: the difference of stresses over the largest pressure")


@claim
def halves_of_a_roller_of_quadrangles_have_pressure_and_stress_of_whole_ones(programs):
    """Within 1 % of the largest pressure: stress along x and y of each image."""
    compare_rollers(programs, "quadrangle", of_images=each_image)


@claim
def halves_of_a_roller_of_triangles_have_pressure_and_stress_of_whole_ones(programs):
    """Within 1 % of the largest pressure: stress along x and y in the mean of the images."""
    compare_rollers(programs, "triangle", of_images=mean_image)


@claim
def finite_rollers_have_pressure_and_stress_of_small_ones_where_they_touch(programs):
    """Of quadrangles, within 1 % of the largest pressure, which is 0.05 % of Young's modulus."""
    small, finite = (Roller(programs, kinematics, "quadrangle", BOTH) for kinematics in ("small", "finite"))
    near(numpy.abs(finite.pressures - small.pressures).max(), 0, 0.01, "the difference of pressures over the largest one")
    near(numpy.abs(finite.stress - small.stress)[:, :, 0].max(), 0, 0.01, "the difference of stresses over the largest pressure")


# A press fit -------------------------------------------------------------------------------------------------------------

RADII = {"shaft": (0.7, 1.0), "ring": (1.0, 1.3)}
EXCESS = 1e-3  # of the radius of the shaft over that of the ring
SECTORS, RINGS = 32, 6  # cells of a quarter and of each part


def lame(radius, inner, outer, inside, outside):
    """Radial stress, hoop stress and radial displacement at a radius of a ring under pressures, in plane strain."""
    mean = (inside * inner**2 - outside * outer**2) / (outer**2 - inner**2)
    swing = (inside - outside) * inner**2 * outer**2 / (outer**2 - inner**2)
    return mean - swing / radius**2, mean + swing / radius**2, (1 + POISSON) * ((1 - 2 * POISSON) * mean * radius + swing / radius)


SEAT = EXCESS / (lame(1, *RADII["ring"], 1, 0)[2] - lame(1, *RADII["shaft"], 0, 1)[2])  # pressure [Pa]
LARGEST_HOOP = abs(lame(RADII["shaft"][0], *RADII["shaft"], 0, 1)[1])  # over it, in the bore of the shaft


class PressFit:
    """A ring on a hollow shaft at rest. Stresses and pressures are over Lame's pressure."""

    def __init__(self, programs, kinematics, shape, images):
        around = [(math.cos(angle), math.sin(angle)) for angle in (math.pi / 2 * k / SECTORS for k in range(SECTORS))] + [(0.0, 1.0)]
        excess = {"shaft": (0, EXCESS / 2), "ring": (-EXCESS / 2, 0)}
        self.parts = {}
        for name, (inner, outer) in RADII.items():
            first, last = inner + excess[name][0], outer + excess[name][1]
            radii = [first + (last - first) * i / RINGS for i in range(RINGS + 1)]
            grid = [[(radius * x, radius * y) for x, y in around] for radius in radii]
            self.parts[name] = Part(grid, shape, ("inside", "outside", "foot", "side"), images)
        with tempfile.TemporaryDirectory() as folder:
            for name, part in self.parts.items():
                part.write(pathlib.Path(folder) / f"{name}.msh")
            bodies = "".join(f"""[bodies.{name}]
mesh = "{name}.msh"
young = 1
poisson = {POISSON}
density = 1
kinematics = "{kinematics}"
mass_damping = 0.5
{"" if len(images) > 1 else rollers(name)}""" for name in RADII)
            scene = pathlib.Path(folder) / "fit.toml"
            scene.write_text(f"""dim = 2
energy_scale = 1e-6
{bodies}[[contact.pairs]]
bodies = ["shaft", "ring"]
interference = "resolve"
interference_time = 10
[run]
time = 60
[output]
frames = 2
""")
            done = Run(programs, scene).require_end()
            cells, faces = last_cells(done), last_faces(done)
        self.stress = {name: numpy.stack(turned(part.stress(cells, body) / SEAT, part.middles()), axis=-1)
                       for body, (name, part) in enumerate(self.parts.items())}
        self.hole = faces["group: ring.inside"] > 0
        self.angles = numpy.arctan2(*numpy.abs(faces.centres[self.hole, 1::-1]).T)
        self.faces = faces["contact pressure"][self.hole] / SEAT

    def pressures(self):
        """Of each face of the hole in a quarter, the mean of its images."""
        sector = (self.angles / (math.pi / 2) * SECTORS).astype(int)
        return numpy.bincount(sector, weights=self.faces) / numpy.bincount(sector)


@claim
def quarters_of_a_press_fit_have_pressure_and_hoop_stress_of_lame(programs):
    """Pressure of each face within 1.5 %, of all within 0.5 %; hoop stress of each cell within 2.5 % of the largest one."""
    for shape in ("quadrangle", "triangle"):
        fit = PressFit(programs, "small", shape, QUARTER)
        for pressure in fit.faces:
            near(pressure, 1, 0.015, f"{shape}s: the pressure of a face over Lame's")
        near(fit.faces.mean(), 1, 0.005, f"{shape}s: the mean pressure over Lame's")
        for name, loads in (("shaft", (0, 1)), ("ring", (1, 0))):
            exact = lame(numpy.linalg.norm(fit.parts[name].middles(), axis=-1), *RADII[name], *loads)[1]
            off = numpy.abs(fit.stress[name][0, ..., 1] - exact).max() / LARGEST_HOOP
            near(off, 0, 0.025, f"{name} of {shape}s: the error of the hoop stress over the largest one")


def compare_with_quarter(programs, shape, kinematics_of_whole, of_images):
    quarter = PressFit(programs, "small", shape, QUARTER)
    for kinematics in kinematics_of_whole:
        whole = PressFit(programs, kinematics, shape, WHOLE)
        off = numpy.abs(whole.pressures() - quarter.pressures()).max()
        near(off, 0, 0.01, f"{kinematics}: the difference of pressures over Lame's")
        for name, stress in whole.stress.items():
            off = numpy.abs(of_images(stress) - quarter.stress[name]).max() / LARGEST_HOOP
            near(off, 0, 0.01, f"{name}, {kinematics}: the difference of stresses over the largest one")


@claim
def quarters_of_a_press_fit_of_quadrangles_agree_with_whole_ones(programs):
    """Pressures within 1 % of Lame's; radial and hoop stress of each image within 1 % of the largest stress."""
    compare_with_quarter(programs, "quadrangle", ("small", "floating", "finite"), of_images=each_image)


@claim
def quarters_of_a_press_fit_of_triangles_agree_with_whole_ones(programs):
    """In the mean of the images: pressures within 1 % of Lame's, radial and hoop stress within 1 % of the largest stress."""
    compare_with_quarter(programs, "triangle", ("small", "floating"), of_images=mean_image)


if __name__ == "__main__":
    sys.exit(main(CLAIMS))
