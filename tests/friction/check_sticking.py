#!/usr/bin/env python3
"""What faces that stick must do, and those of a body that spins on its base, each claim by runs of `abut run`.

    check_sticking.py build/dev/bin --list
    check_sticking.py build/dev/bin what_sticks_is_sheared_as_one_body
"""
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import abut_meshes  # noqa: E402
import abut_runs  # noqa: E402
from abut_runs import Claims, balance_of_moved, keys, main, mean, near, require  # noqa: E402

SCENES = pathlib.Path(__file__).parent.parent.parent / "scenes"
claim = Claims()
G, MU = 10.0, 0.3
SMALL_BLOCKS = ["--law", "reconstruction", "--kinematics", "small"]


def run(programs, scene, *options, **more):
    return abut_runs.Run(programs, scene, "--frames", "0", *options, **more)


def sheared(folder, law, rows, columns, uneven):
    """Two blocks of 4 m x 0.5 m, one on the other, whose outer faces have the displacement of a uniform pressure and a uniform shear
    stress, first one, then the other. What is between them has to find it."""
    pressure, stress = 2e3, 1e3
    scene = [f'dim = 2\n[contact]\nfriction = 10\nlaw = "{law}"\n[run]\ntime = 0.45\n']
    pressed, moved = "(t < 0.1 ? 0.5 - 0.5*cos(10*pi*t) : 1)", "(t < 0.15 ? 0 : t < 0.35 ? 0.5 - 0.5*cos(5*pi*(t - 0.15)) : 1)"
    shear, depth = 0.0, 0.0  # of the middle [m]
    for name, young, low, held in (("lower", 1e7, 0.0, "below"), ("upper", 2e7, 0.5, "above")):
        modulus, p_wave_modulus = young / 2.6, young * 0.7 / 1.3 / 0.4  # nu = 0.3
        n = 0 if name == "lower" else 1
        abut_meshes.block_of_rows(pathlib.Path(folder) / f"{name}.msh", name, (0, low), (4, low + 0.5), (columns[n], rows[n]), uneven,
                                  ("left", "right", held))
        along, across = f"{shear!r} + {stress / modulus!r}*(y - {low})", f"{depth!r} + {pressure / p_wave_modulus!r}*(y - {low})"
        scene.append(f'[bodies.{name}]\nmesh = "{name}.msh"\nyoung = {young}\npoisson = 0.3\ndensity = 1000\nkinematics = "small"\n'
                     f'stiffness_damping = 1e-4\n[supports.{name}]\ngroup = "{name}.held"\n'
                     f'value = ["{moved}*({along})", "-{pressed}*({across})"]\n[output.probes.{name}]\nbody = "{name}"\ncontact = true\n')
        shear, depth = shear + 0.5 * stress / modulus, depth + 0.5 * pressure / p_wave_modulus
    path = pathlib.Path(folder) / "patch.toml"
    path.write_text("".join(scene))
    return path, 4 * stress, 4 * pressure


def shear_patch(programs, law, rows, columns, uneven):
    """Shear force and pressure between the blocks over those of the uniform field, and what friction takes [J/m]."""
    with tempfile.TemporaryDirectory() as folder:
        scene, shear, pressure = sheared(folder, law, rows, columns, uneven)
        done = run(programs, scene).require_end()
        last = done.rows("probes.csv")[-1]
        return -last["upper.friction_x"] / shear, last["upper.contact_normal_y"] / pressure, done.rows()[-1]["dissipated_by_friction"]


PATCHES = [((4, 5), (28, 28), 0.0), ((4, 5), (28, 44), 0.3), ((8, 10), (56, 88), 0.0)]  # rows and columns of both, unevenness


@claim
def what_sticks_is_sheared_as_one_body(programs):
    """A patch test: faces that stick bear the shear stress, whatever their meshes. Cells behind them are reconstructed as free, which
    changes the stiffness of the whole by the shear of less than 0.35 of a row of cells: it falls with the size of the cells."""
    for law in ("reconstruction", "pair_potential"):
        for rows, columns, uneven in PATCHES:
            shear, pressure, lost = shear_patch(programs, law, rows, columns, uneven)
            near(shear, 1.0, 0.35 / sum(rows), f"{law}, {rows} rows of {columns}: the shear force")
            near(pressure, 1.0, 0.35 / sum(rows), f"{law}, {rows} rows of {columns}: the pressure")
            require(lost < 1e-6, f"{law}, {rows} rows of {columns}: faces slide, {lost:.2g} J")


def shaken(programs, *options, load=0.3, time=4.6):
    """The blocks of block_on_block at a part of the limit, on a floor that swings up and down with 5 Hz, an acceleration of up to
    2 m/s^2 and no shock: whether anything is lost in the second half, and how far both creep in the last quarter [m]."""
    done = run(programs, SCENES / "block_on_block.toml", *options,
               *keys(values__load=load, values__a=2 / (10 * math.pi)**2, values__f=5, values__r=1, run__time=time,
                     obstacles__plane__path='[0, "a*(t < r ? 0.5 - 0.5*cos(pi*t/r) : 1)*(1 - cos(2*pi*f*t))"]',
                     output__probes__block='{body="block", contact=true}')).require_end()
    rows, probes = done.rows(), done.rows("probes.csv")
    forces = [row["block.contact_normal_y"] for row in probes[len(probes) // 2:]]
    require(min(forces) < 0.83 * mean(forces) and max(forces) > 1.17 * mean(forces), "the normal force does not vibrate")
    require(balance_of_moved(rows) < 1e-9, f"the balance is open by {balance_of_moved(rows):.2g}")
    quarter = len(probes) // 4
    creep = max(abs(mean(row[f"{name}.displacement_x"] for row in probes[-quarter:]) -
                    mean(row[f"{name}.displacement_x"] for row in probes[-2 * quarter:-quarter])) for name in ("block", "slab"))
    return rows[-1]["dissipated_by_friction"] - rows[len(rows) // 2]["dissipated_by_friction"], creep


@claim
def what_sticks_does_not_creep_while_its_normal_force_vibrates(programs):
    """N swings by a fifth, and the blocks bear 0.3 of their limit: nothing is dissipated once the swing is steady, and nothing creeps. At 0.5
    faces at the edges reach their limit now and then: the figure sees it."""
    for options, time in (([], 4.6), (SMALL_BLOCKS, 9.2)):
        lost, creep = shaken(programs, *options, time=time)
        require(lost == 0.0, f"{options}: {lost:.3g} J are lost")
        require(creep <= 1e-9, f"{options}: they creep by {creep:.3g} m")
    lost, creep = shaken(programs, load=0.5)
    require(lost > 1e-6, f"at half the limit {lost:.3g} J are lost")


def spin_moment(programs, rings, sectors, layers=1, time=0.08, options=()):
    """Moment of friction over 2/3 mu N R, and the open balance. The cylinder stands at rest on a floor that begins to turn; R is the
    radius of a disc of the area of its base."""
    radius, length = 0.1, 0.05
    with tempfile.TemporaryDirectory() as folder:
        abut_meshes.cylinder_of_rings(pathlib.Path(folder) / "cylinder.msh", "cylinder", radius, length, rings, sectors, layers)
        scene = pathlib.Path(folder) / "cylinder.toml"
        scene.write_text(SPINNING)
        done = run(programs, scene, *keys(run__time=time), *options).require_end()
    mass = done.body("cylinder")["mass"]
    disc = math.sqrt(mass / 1000 / length / math.pi)
    points = [(row["time"], row["angular_momentum_z"]) for row in done.rows() if row["time"] > 0.02]
    middle = mean(t for t, _ in points)
    moment = sum((t - middle) * value for t, value in points) / sum((t - middle)**2 for t, _ in points)
    return moment / (2 / 3 * MU * mass * G * disc), balance_of_moved(done.rows())


@claim
def a_cylinder_that_spins_on_its_base_feels_two_thirds_of_mu_n_r(programs):
    """Uniform pressure: M = mu p int r dA = 2/3 mu N R, while the cylinder lies flat."""
    for rings, sectors, allowed in ((3, 12, 0.01), (3, 24, 0.004), (4, 24, 0.004)):
        moment, open_by = spin_moment(programs, rings, sectors)
        near(moment, 1.0, allowed, f"{rings} rings of {sectors}: the moment over 2/3 mu N R")
        require(open_by <= 1e-11, f"{rings} rings of {sectors}: the balance is open by {open_by:.2g}")


SPINNING = """
dim = 3
gravity = [0, 0, -10]
[values]
spin = 20
ramp = 0.005
[contact]
friction = 0.3
[bodies.cylinder]
mesh = "cylinder.msh"
young = 1e7
poisson = 0.3
density = 1000
kinematics = "rigid"
[obstacles.floor]
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
half_width = 0.3
rotation = [0, 0, "spin*(t < ramp ? t^2/2/ramp : t - ramp/2)"]
[run]
settle = true
time = 0.08
"""


if __name__ == "__main__":
    sys.exit(main(claim))
