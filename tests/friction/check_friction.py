#!/usr/bin/env python3
"""What friction must do, each claim by runs of `abut run`.

    check_friction.py build/dev/bin --list
    check_friction.py build/dev/bin slide_at_30_degrees

The right values come from balances of energy, momentum and moments, and from closed forms, which stand beside each claim.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import abut_meshes  # noqa: E402
import abut_runs  # noqa: E402
from abut_runs import Claims, balance_of_moved, excess, keys, main, near, open_by, require, slope  # noqa: E402

INPUTS = pathlib.Path(__file__).parent / "inputs"
SCENES = pathlib.Path(__file__).parent.parent.parent / "scenes"
claim = Claims()
G, MU = 10.0, 0.3
# Laws of contact and kinematics of the body: all under which a body may rub.
LAWS_AND_KINEMATICS = [("reconstruction", "small"), ("pair_potential", "small"), ("pair_potential", "floating"), ("pair_potential", "finite"),
        ("pair_potential", "rigid")]

# (ranks, law, kinematics), on 2 and 3 ranks in turn. A rigid body is on one.
ON_RANKS = [(1 if kinematics == "rigid" else 2 + n % 2, law, kinematics) for n, (law, kinematics) in enumerate(LAWS_AND_KINEMATICS)]


def run(programs, scene, *options, **more):
    return abut_runs.Run(programs, INPUTS / scene, "--frames", "0", *options, **more)


def with_law(law, kinematics):
    return ["--law", law, "--kinematics", kinematics]


def balance(rows, scale=None):
    """Largest |H~ + D - W| from its start, over the energies that moved, or over `scale` [J]."""
    return open_by(rows) / scale if scale else balance_of_moved(rows)


def acceleration(rows, mass, begin=0.3):
    part = rows[int(begin * len(rows)):]
    return slope([(row["time"], row["linear_momentum_x"] / mass) for row in part])


def on_incline(degrees):
    angle = math.radians(degrees)
    return keys(bodies__block__velocity="[0, 0]", gravity=f"[{G * math.sin(angle)}, {-G * math.cos(angle)}]")


# --- A block on a plane ---------------------------------------------------------------------------------------------


@claim
def slide_at_30_degrees(programs):
    """a = g (sin - mu cos), within 1 % g; a rigid body within 0.2 %."""
    right = G * (math.sin(math.pi / 6) - MU * math.cos(math.pi / 6))
    for law, kinematics in LAWS_AND_KINEMATICS:
        done = run(programs, "block.toml", *with_law(law, kinematics), *on_incline(30)).require_end()
        rows = done.rows()
        allowed = 0.002 if kinematics == "rigid" else 0.01
        near(acceleration(rows, done.body("block")["mass"]), right, allowed * G, f"{law}, {kinematics}: the acceleration")
        require(balance(rows) <= 1e-11, f"{law}, {kinematics}: the balance is open by {balance(rows):.2g}")


@claim
def stick_at_10_degrees(programs):
    """tan 10 degrees is less than mu: the block, let go from no contact, swings on its own stiffness and does not slide."""
    for law, kinematics in LAWS_AND_KINEMATICS:
        done = run(programs, "block.toml", *with_law(law, kinematics), *on_incline(10)).require_end()
        rows, mass = done.rows(), done.body("block")["mass"]
        half = len(rows) // 2
        drift = (sum(row["linear_momentum_x"] for row in rows[half:]) / len(rows[half:])) / mass
        near(drift, 0.0, 1e-3, f"{law}, {kinematics}: the mean velocity of the second half")
        weight = mass * G * 1.0  # [J], lifted by 1 m
        require(balance(rows, weight) <= 1e-12, f"{law}, {kinematics}: the balance is open by {balance(rows, weight):.2g}")
        fallen = mass * G * G * math.sin(math.radians(10)) ** 2 / 2  # what gravity would have done in 1 s without friction
        require(rows[-1]["dissipated"] <= 1e-2 * fallen, f"{law}, {kinematics}: {rows[-1]['dissipated']:.3g} J are lost")


@claim
def a_block_on_a_block_stands_still(programs):
    """Brought to rest with faces that stick, below their limit: nothing slides, nothing is dissipated, nothing creeps."""
    for load in (0, 0.3, 0.6):
        done = run(programs, SCENES / "block_on_block.toml", *keys(values__load=load, run__time=1)).require_end()
        rows = done.rows()
        require(rows[-1]["dissipated"] == 0.0, f"load {load}: {rows[-1]['dissipated']:.3g} J are lost")
        require(max(row["sliding_faces"] for row in rows) == 0, f"load {load}: faces slide")
        for name in ("block", "slab"):
            x = [row[f"{name}.displacement_x"] for row in done.rows("probes.csv")]
            require(max(abs(value - x[0]) for value in x) <= 1e-14, f"load {load}: {name} moves by {max(abs(v - x[0]) for v in x):.2g} m")


@claim
def slide_stop_stay(programs):
    """All of the kinetic energy is dissipated, and nothing more once the block has stopped."""
    for law, kinematics in LAWS_AND_KINEMATICS:
        rows = run(programs, "block.toml", *with_law(law, kinematics), *keys(run__time=4)).require_end().rows()
        start, half = rows[0]["kinetic"], rows[len(rows) // 2]
        near(rows[-1]["dissipated"] / start, 1.0, 5e-3, f"{law}, {kinematics}: D/K0")
        require(rows[-1]["dissipated"] - half["dissipated"] <= 2e-3 * start, f"{law}, {kinematics}: it goes on losing")
        require(balance(rows) <= 1e-11, f"{law}, {kinematics}: the balance is open by {balance(rows):.2g}")
        require(excess(rows) <= 1e-2 * start, f"{law}, {kinematics}: H - H~ is {excess(rows) / start:.2g} K0")


@claim
def stopping_distance(programs):
    """v^2/(2 mu g): of a damped block at any step within 0.5 %. One that nothing damps rings, and runs at steps that differ by 0.4 % by
    1 %: the mean of four is within 4 %, and what slides bears 0.95 of its limit."""
    def path_of(*options):
        done = run(programs, "block.toml", "--interval", 1, *keys(run__time=0.9), *options).require_end()
        return stopping_path(done.rows(), done.body("block")["mass"]) / (4.0 / (2 * MU * G)), done.summary["friction"]["sliding_share"]

    for cfl in (0.9, 0.45, 0.225):
        near(path_of("--cfl", cfl, *keys(bodies__block__stiffness_damping=1e-4))[0], 1.0, 0.005, f"cfl {cfl}, damped: the path over v^2/(2 mu g)")
    paths, shares = zip(*(path_of("--cfl", 0.9 * (1 - 0.004 * i)) for i in range(4)))
    near(sum(paths) / 4, 1.0, 0.04, "nothing damps: the mean path over v^2/(2 mu g)")
    require(sum(shares) / 4 >= 0.95, f"what slides bears {shares} of its limit")


@claim
def shaken_table(programs):
    """The block never loses more than the table gave; without restarts that is lost, and said."""
    table = keys(bodies__block__velocity="[0, 0]", obstacles__floor__path='["0.5/(4*pi)*(1 - cos(4*pi*t))", "0"]',
                 run__time=11.2)
    for law, kinematics in (("reconstruction", "small"), ("pair_potential", "floating")):
        done = run(programs, "block.toml", *with_law(law, kinematics), *table).require_end()
        rows, start = done.rows(), 0.5 * done.body("block")["mass"] * 0.5**2
        last = rows[-1]
        require(20 * start < last["dissipated"] < last["work"], f"{law}: D is {last['dissipated']}, W {last['work']}")
        require(balance(rows) <= 1e-11, f"{law}: the balance is open by {balance(rows):.2g}")
        require(excess(rows) <= 1e-2 * (start + last["work"]), f"{law}: H - H~ is {excess(rows):.3g} J")
        require("alternates" not in done.said, f"{law}: it warns of a slip that alternates")
        lost = run(programs, "block.toml", *with_law(law, kinematics), *table, "--filter", "neutral", "--restart", "0")
        require(lost.warns_of("H - H~ came to"),
                f"{law}: without restarts nothing is said:\n{lost.said}")


@claim
def a_slip_that_alternates_is_said(programs):
    """In the end the faces of a shaken block slide back and forth in each step: the balance holds, and D is more than W."""
    table = keys(bodies__block__velocity="[0, 0]", obstacles__floor__path='["0.5/(4*pi)*(1 - cos(4*pi*t))", "0"]',
                 run__time=22)
    done = run(programs, "block.toml", *table, "--filter", "neutral", "--restart", "0").require_end()
    last = done.rows()[-1]
    require(last["dissipated"] > last["work"], "the run is not lost: this scene shows nothing")
    require(balance(done.rows()) <= 1e-11, "the balance is open")
    require(done.warns_of("alternates from step to step"), f"nothing is said:\n{done.said}")


@claim
def a_slip_that_alternates_in_a_part_of_a_run_is_said(programs):
    """At half the step the shaken block is lost in the last part of its time: the mean over the whole run hides it."""
    table = keys(bodies__block__velocity="[0, 0]", obstacles__floor__path='["0.5/(4*pi)*(1 - cos(4*pi*t))", "0"]',
                 run__time=23)
    done = run(programs, "block.toml", *table, "--cfl", "0.45", "--filter", "neutral", "--restart", "0").require_end()
    friction = done.summary["friction"]
    require(friction["sliding_share"] > 0.6, f"the whole run has {friction['sliding_share']:.2g}: this scene shows nothing of parts")
    require(friction["least_sliding_share"] < 0.1, f"the least of a part is {friction['least_sliding_share']:.2g}")
    require(done.warns_of("alternates from step to step"), f"nothing is said:\n{done.said}")


@claim
def belt_and_floor(programs):
    """A block that is put on a belt at 1 m/s ends with its velocity: D = m V^2/2, W = m V^2 on the belt."""
    done = run(programs, "block.toml", *keys(bodies__block__velocity="[0, 0]", obstacles__floor__velocity="[1, 0]")).require_end()
    mass, last = done.body("block")["mass"], done.rows()[-1]
    near(done.body("block")["velocity_final"][0], 1.0, 5e-3, "the velocity")
    near(last["dissipated"] / (0.5 * mass), 1.0, 1e-2, "D over m V^2/2")
    near(last["work"] / mass, 1.0, 1e-2, "W over m V^2")


@claim
def block_in_space(programs):
    """Friction is against the motion, whatever the mesh: the direction stays, a = mu g."""
    done = run(programs, "block_3d.toml").require_end()
    x, y, _ = done.body("block")["velocity_final"]
    near(math.atan2(y, x), 0.4, 0.03, "the direction [rad]")
    near((1.0 - math.hypot(x, y)) / 0.25, MU * G, 0.025 * MU * G, "the deceleration")
    require(balance(done.rows()) <= 1e-11, "the balance is open")


# --- Laws and pairs ---------------------------------------------------------------------------------------------------


@claim
def pairs_have_their_own_friction(programs):
    """The lower block sticks to the floor (0.1 x 15,200 N) under the upper one (0.3 x 3,200 N), which slows down by mu g."""
    done = run(programs, "two_blocks.toml").require_end()
    near(done.body("upper")["velocity_final"][0], 2.0 - MU * G * 0.3, 0.02, "the velocity of the upper block")
    near(done.body("lower")["velocity_final"][0], 0.0, 0.02, "that of the lower one")
    require(balance(done.rows()) <= 1e-11, "the balance is open")


@claim
def a_pair_without_friction_is_bitwise_identical(programs):
    """Two bodies that do not rub among others that would: energies are those of a scene without friction."""
    options = ["--filter", "neutral", "--restart", 10]
    other = ["--set", 'contact.pairs=[{bodies=["block", "floor"], friction=0}]']
    for law, kinematics in (("reconstruction", "small"), ("pair_potential", "floating")):
        none = run(programs, "block.toml", *with_law(law, kinematics), *options, *keys(contact__friction=0)).require_end()
        pair = run(programs, "block.toml", *with_law(law, kinematics), *options, *other).require_end()
        require((none.out / "energy.csv").read_bytes() == (pair.out / "energy.csv").read_bytes(), f"{law}: other bits")
        before, after = (pair.rows()[i]["linear_momentum_x"] for i in (0, -1))
        near(after / before, 1.0, 1e-8, f"{law}: momentum along the floor")


def block_of_halves(folder):
    """A mesh file of the block of block.toml, 8 x 4 cells; the sole has the groups "left" and "right", and "sole", all of it."""
    nodes = [(0.1 * i, 0.1 * j) for j in range(5) for i in range(9)]
    elements = [(1, group, (i, i + 1)) for i in range(8) for group in ("left" if i < 4 else "right", "sole")]
    elements += [(2, "block", (9 * j + i, 9 * j + i + 1, 9 * j + i + 10, 9 * j + i + 9)) for j in range(4) for i in range(8)]
    return abut_meshes.write_msh(pathlib.Path(folder) / "halves.msh", nodes, elements)


def halves(folder, *pairs):
    """The scene block.toml with that mesh, and with laws of friction of groups and bodies."""
    text = (INPUTS / "block.toml").read_text()
    begin, end = text.index('shape = "structured_box"'), text.index("young")
    path = pathlib.Path(folder) / "halves.toml"
    path.write_text(text[:begin] + f'mesh = "{block_of_halves(folder).name}"\n' + text[end:] +
                    "".join(f"[[contact.pairs]]\n{pair}\n" for pair in pairs))
    return path


def of_group(group, friction):
    return f'groups = ["block.{group}"]\nbodies = ["floor"]\nfriction = {friction}'


@claim
def groups_of_faces_have_their_own_friction(programs):
    """A rigid block, L long with its centre at the height h, slides on two halves of its sole with mu_1 behind and mu_2 in front.
    The pressure is linear along the sole: N_2 - N_1 = 3 h F/L, N_1 + N_2 = m g, so that F = mu_1 N_1 + mu_2 N_2 is
    m g (mu_1 + mu_2)/2/(1 - 3 h (mu_2 - mu_1)/(2 L))."""
    length, height = 0.8, 0.2
    for behind, ahead in ((0.1, 0.4), (0.4, 0.1)):
        right = G * (behind + ahead) / 2 / (1 - 1.5 * height * (ahead - behind) / length)
        with tempfile.TemporaryDirectory() as folder:
            scene = halves(folder, of_group("left", behind), of_group("right", ahead))
            done = run(programs, scene, *with_law("pair_potential", "rigid"), "--settle",
                       *keys(bodies__block__velocity="[4, 0]")).require_end()
            near(-acceleration(done.rows(), done.body("block")["mass"]), right, 0.005 * G, f"mu {behind}, {ahead}: the deceleration")
            require(balance(done.rows()) <= 1e-11, "the balance is open")


@claim
def laws_of_groups_go_before_those_of_bodies(programs):
    """Two halves with one law are a whole; more groups go before fewer, and then the law that comes first: bitwise identical."""
    for law, kinematics in LAWS_AND_KINEMATICS:
        with tempfile.TemporaryDirectory() as folder:
            def energies(*pairs):
                options = [*with_law(law, kinematics), *keys(run__time=0.1, contact__friction=0.7)]
                done = run(programs, halves(folder, *pairs), *options).require_end()
                return (done.out / "energy.csv").read_bytes()
            body = 'bodies = ["block", "floor"]\nfriction = '
            whole = energies(body + "0.3")
            require(energies(of_group("left", 0.3), of_group("right", 0.3)) == whole, f"{law}, {kinematics}: halves are no whole")
            require(energies(body + "0.1", of_group("sole", 0.3), of_group("left", 0.2)) == whole,
                    f"{law}, {kinematics}: the order of laws is another")
            require(energies(body + "0.1", of_group("left", 0.2), of_group("sole", 0.3)) != whole,
                    f"{law}, {kinematics}: the first law of a face does not count")


@claim
def groups_are_bitwise_identical_on_ranks_and_after_a_restart(programs):
    for ranks, law, kinematics in ON_RANKS:
        with tempfile.TemporaryDirectory() as folder:
            scene = halves(folder, of_group("left", 0.1), of_group("right", 0.5))
            options = [*with_law(law, kinematics), "--interval", 7]
            whole = run(programs, scene, *options, *keys(run__time=0.04)).require_end()
            energies = (whole.out / "energy.csv").read_bytes()
            if ranks > 1:
                shared = run(programs, scene, *options, *keys(run__time=0.04), "--ranks", ranks).require_end()
                require((shared.out / "energy.csv").read_bytes() == energies, f"{law}, {kinematics}: {ranks} ranks have other bits")
            part = pathlib.Path(folder) / "part"
            for command in ([programs / "abut", "run", scene, "--frames", "0", *options, *keys(run__time=0.02), "--out", part,
                             "--keep-last-checkpoint"], [programs / "abut", "restart", part, "--until", "0.04"]):
                done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
                require(done.returncode == 0, done.stdout + done.stderr)
            expected, got = whole.rows()[-1], list(abut_runs.rows_of(part / "energy.csv"))[-1]
            require(expected == got, f"{law}, {kinematics}: {expected} became {got}")


@claim
def laws_that_cannot_act_are_refused(programs):
    body = 'bodies = ["block", "floor"]\nfriction = 0.1'
    for pairs, options, words in (
            ([of_group("lefd", 0.1)], [], ["'block.lefd', which is no group", "Did you mean 'block.left'?"]),
            ([of_group("left", 0.1)] * 2, [], ["'floor' and 'block.left' have two laws"]),
            (['groups = ["block.left"]\nfriction = 0.1'], [], ["name 1 together, 2 are needed"]),
            (['groups = ["block.left", "block.right"]\nbodies = ["floor"]\nfriction = 0.1'], [], ["name 3 together"]),
            (['groups = ["block.left", "block.right"]\nfriction = 0.1'], [], ["never touch"]),
            ([body], keys(contact__ignored_pairs='[["floor", "block"]]'), ["'block' and 'floor'", "never touch", "ignored_pairs"]),
            ([of_group("left", 0.1)], keys(contact__ignored_pairs='[["floor", "block"]]'), ["never touch"])):
        with tempfile.TemporaryDirectory() as folder:
            done = run(programs, halves(folder, *pairs), *options)
            said = " ".join(done.said.split())
            require(done.code == 1 and all(word in said for word in words), f"{pairs}, {options}: {done.said}")


@claim
def tresca_takes_a_stress(programs):
    """The force is c A, whatever presses: a = c A/m. The block stands on its whole side, 0.8 m."""
    strength = 600.0
    done = run(programs, "block.toml", *keys(contact__friction=0, contact__shear_strength=strength, run__time=0.5)).require_end()
    mass = done.body("block")["mass"]
    require(-strength * 0.8 / mass * 1.02 <= acceleration(done.rows(), mass, 0.2) <= -strength * 0.8 / mass * 0.7,
            f"the acceleration is {acceleration(done.rows(), mass, 0.2)}")


@claim
def friction_falls_with_speed(programs):
    """At 20 m/s and a decay speed of 1 m/s the coefficient is that of sliding."""
    done = run(programs, "block.toml", *keys(bodies__block__velocity="[20, 0]", contact__friction=0.6,
                                             contact__sliding_friction=0.1, contact__decay_speed=1)).require_end()
    near(acceleration(done.rows(), done.body("block")["mass"]), -0.1 * G, 0.02 * G, "the acceleration")


# --- Discs --------------------------------------------------------------------------------------------------------------


@claim
def wheel_on_a_belt_rolls(programs):
    """Friction stops when v + omega R = V: v = V/3 for a disc."""
    done = run(programs, "belt.toml").require_end()
    near(done.body("wheel")["velocity_final"][0], 1 / 3, 0.02, "the velocity")
    near(done.body("wheel")["spin_final"][0] * 0.2, 2 / 3, 0.02, "omega R")


@claim
def spinning_discs(programs):
    """Free bodies keep momentum and J~ to round-off; at full slip J_T = mu J_N."""
    for kinematics, allowed in (("floating", 0.005), ("rigid", 0.02)):
        done = run(programs, "discs.toml", "--kinematics", kinematics).require_end()
        left = done.body("left")
        change = [after - before for before, after in zip(left["velocity_initial"], left["velocity_final"])]
        require(change[1] < 0, f"{kinematics}: friction pushes in the wrong direction")
        near(-change[1] / (0.1 * -change[0]), 1.0, allowed, f"{kinematics}: J_T/(mu J_N)")
        spin = left["spin_final"][0] - left["spin_initial"][0]
        near(spin * 0.2 / (2 * change[1]), 1.0, 0.06, f"{kinematics}: the change of spin over J_T R/I")
        summary = done.summary
        require(summary["momentum_drift_max"] <= 1e-13 * left["mass"] * 40, f"{kinematics}: momentum is not kept")
        require(summary["pseudo_angular_momentum_drift_max"] <= 1e-13 * left["mass"] * 0.04 * 40, f"{kinematics}: J~ is not kept")
        require(balance(done.rows()) <= 1e-12, f"{kinematics}: the balance is open")


# --- Bodies that dissipate, too ------------------------------------------------------------------------------------------


def stopping_path(rows, mass):
    return sum(row["linear_momentum_x"] / mass * (row["time"] - before["time"]) for before, row in zip(rows, rows[1:]))


@claim
def bodies_that_yield_rub(programs):
    """Plastic flow and friction share what a block has that slides to its stop: each is booked, and the path is v^2/(2 mu g)."""
    metal = keys(bodies__block__law='"j2"', bodies__block__yield_stress=8e3, bodies__block__hardening=1e6)
    for kinematics in ("small", "floating", "finite"):
        done = run(programs, "block.toml", *with_law("pair_potential", kinematics), "--interval", 1, *metal).require_end()
        rows, start = done.rows(), done.rows()[0]["kinetic"]
        last = rows[-1]
        require(last["dissipated_in_cells"] > 1e-3 * start, f"{kinematics}: nothing flows")
        of_friction = last["dissipated_by_friction"]
        require(of_friction > 0.9 * start, f"{kinematics}: friction takes {of_friction:.4g} of {start:.4g} J")
        near(last["dissipated"] / start, 1.0, 5e-3, f"{kinematics}: D/K0")
        near(stopping_path(rows, done.body("block")["mass"]) / (4.0 / (2 * MU * G)), 1.0, 0.05, f"{kinematics}: the path over v^2/(2 mu g)")
        require(balance(rows) <= 1e-11, f"{kinematics}: the balance is open by {balance(rows):.2g}")


@claim
def bodies_that_damp_rub(programs):
    """Faces that do not vibrate do not reverse: the path of a damped block is v^2/(2 mu g) within 1 %."""
    for kinematics in ("small", "floating", "finite"):
        done = run(programs, "block.toml", *with_law("pair_potential", kinematics), "--interval", 1,
                   *keys(bodies__block__stiffness_damping=1e-4)).require_end()
        rows, start = done.rows(), done.rows()[0]["kinetic"]
        require(rows[-1]["dissipated_by_damping"] > 1e-4 * start, f"{kinematics}: nothing is damped")
        near(rows[-1]["dissipated"] / start, 1.0, 2e-3, f"{kinematics}: D/K0")
        near(stopping_path(rows, done.body("block")["mass"]) / (4.0 / (2 * MU * G)), 1.0, 0.01, f"{kinematics}: the path over v^2/(2 mu g)")
        require(balance(rows) <= 1e-11, f"{kinematics}: the balance is open by {balance(rows):.2g}")


@claim
def a_body_rubs_on_itself(programs):
    """Arms of a clip that touch: friction between them is booked, on two ranks with the same bits, and mu = 0 is no law."""
    def clip(*options):
        done = run(programs, SCENES / "closing_clip.toml", *options).require_end()
        return done, done.rows()

    _, none = clip()
    _, zero = clip(*keys(contact__friction=0))
    require(zero == none, "mu = 0 has other bits than no friction")
    for options in (keys(contact__friction=0.3), ["--kinematics", "small", *keys(contact__friction=0.3)]):
        done, rows = clip(*options)
        require(rows[-1]["dissipated_by_friction"] > 0, f"{options}: friction dissipates nothing")
        require(max(row["sliding_faces"] for row in rows) > 0, f"{options}: nothing slides")
        require(balance(rows) <= 1e-11, f"{options}: the balance is open by {balance(rows):.2g}")
    short = keys(contact__friction=0.3, run__time=0.4)
    _, one = clip(*short)
    require(one[-1]["dissipated_by_friction"] > 0, "arms do not touch within 0.4 s: this shows nothing of ranks")
    require(clip(*short, "--ranks", 2)[1] == one, "2 ranks have other bits")


@claim
def a_tip_that_leans_rubs(programs):
    """The needle of 20 degrees comes down on its point at a slant: facets across the tip rub as all others do. The impulses of contact
    are its change of momentum, and H~ + D and J~ are kept."""
    lean = keys(bodies__needle__turn='"20 deg"', bodies__needle__place="[0.1, 0.02]", bodies__needle__velocity="[1.0, -1.2]",
                contact__friction=MU, output__interval=1, output__probes__needle='{body="needle", contact=true}')
    for kinematics in ("floating", "finite", "rigid"):
        done = run(programs, SCENES / "falling_needle.toml", *lean, *keys(bodies__needle__kinematics=f'"{kinematics}"'), "--filter", "none",
                   "--restart", 10).require_end()
        rows, probes, mass = done.rows(), done.rows("probes.csv"), done.body("needle")["mass"]
        for axis in "xy":
            taken = sum((row[f"needle.contact_normal_{axis}"] + row[f"needle.friction_{axis}"]) * (row["time"] - before["time"])
                        for before, row in zip(probes, probes[1:]))
            change = mass * (probes[-1][f"needle.velocity_{axis}"] - probes[0][f"needle.velocity_{axis}"])
            near(taken, change, 1e-10 * mass, f"{kinematics}: the impulse along {axis}")
        friction, energy = done.summary["friction"], rows[0]["kinetic"]
        require(friction["dissipated"] > 0.01 * energy, f"{kinematics}: D is {friction['dissipated']:.2g} J of {energy:.2g}")
        require(friction["least_dissipated"] >= -1e-15 * energy, f"{kinematics}: a step has fed {-friction['least_dissipated']:.2g} J")
        require(friction["force_over_limit_max"] <= 1 + 1e-12, f"{kinematics}: a face rubs by more than mu N")
        require(done.summary["missed_contacts"] == 0, f"{kinematics}: contacts are missed")
        require(done.summary["compression_max"] <= 0.3, f"{kinematics}: pressed in by {done.summary['compression_max']:.2g} of a cell")
        require(done.summary["pseudo_angular_momentum_drift_max"] <= 1e-12 * mass, f"{kinematics}: J~ is not kept")
        require(balance(rows) <= 1e-12, f"{kinematics}: the balance is open by {balance(rows):.2g}")


# --- Runs -----------------------------------------------------------------------------------------------------------------


@claim
def a_restart_is_bitwise_identical(programs):
    """A run that is stopped in mid-slip and goes on, and one that was not."""
    for law, kinematics, *more in (("reconstruction", "small"), ("pair_potential", "floating"), ("pair_potential", "rigid"),
                                   ("pair_potential", "floating", "--settle")):
        with tempfile.TemporaryDirectory() as folder:
            options = [*with_law(law, kinematics), *more, "--interval", 7]
            whole = run(programs, "block.toml", *options, *keys(run__time=0.3)).require_end()
            first = run(programs, "block.toml", *options, *keys(run__time=0.3), "--checkpoint-steps", 97, "--set",
                        "output.keep_last_checkpoint=true", folder=folder).require_end()
            require((whole.out / "energy.csv").read_bytes() == (first.out / "energy.csv").read_bytes(), "checkpoints change bits")
            part = pathlib.Path(folder) / "part"
            command = [programs / "abut", "run", INPUTS / "block.toml", "--frames", "0", *options, "--out", part]
            subprocess.run(list(map(str, [*command, *keys(run__time=0.15), "--keep-last-checkpoint"])), check=True,
                           capture_output=True)
            done = subprocess.run(list(map(str, [programs / "abut", "restart", part, "--until", "0.3"])), capture_output=True,
                                  text=True)
            require(done.returncode == 0, done.stdout + done.stderr)
            expected, got = whole.rows()[-1], list(abut_runs.rows_of(part / "energy.csv"))[-1]
            require(expected == got, f"{law}, {kinematics}: {expected} became {got}")


@claim
def runs_are_bitwise_identical_on_ranks(programs):
    for ranks, law, kinematics, *more in ((2, "reconstruction", "small"), (3, "pair_potential", "floating"),
                                          (3, "reconstruction", "small", "--settle"), (2, "pair_potential", "floating", "--settle")):
        options = [*with_law(law, kinematics), *more, *keys(run__time=0.01, bodies__block__counts="[16, 8]")]
        one = run(programs, "block.toml", *options).require_end()
        shared = run(programs, "block.toml", *options, "--ranks", ranks).require_end()
        require((one.out / "energy.csv").read_bytes() == (shared.out / "energy.csv").read_bytes(),
                f"{options}: {ranks} ranks have other bits")


CONTACT_PROBE = 'output.probes.block={body="block", contact=true}'


@claim
def probes_split_contact_and_give_its_slip(programs):
    """Both forces, summed over time, are the change of momentum, less gravity; friction alone is what brakes along the floor, and
    mu N times the velocity of slip is D, where the block slides one way: within 1 %, as faces that vibrate have up to that less.
    Without the filter, which holds the block against the floor by an impulse of its own, across it."""
    for law, kinematics in LAWS_AND_KINEMATICS:
        done = run(programs, "block.toml", *with_law(law, kinematics), *keys(run__time=0.3), "--filter", "none", "--restart", 10,
                   "--set", CONTACT_PROBE).require_end()
        rows, probes = done.rows(), done.rows("probes.csv")
        def impulse(column):
            return sum(row[f"block.{column}"] * (row["time"] - before["time"]) for before, row in zip(probes, probes[1:]))
        change = [rows[-1][f"linear_momentum_{axis}"] - rows[0][f"linear_momentum_{axis}"] for axis in "xy"]
        weight = done.body("block")["mass"] * G * rows[-1]["time"]
        near(impulse("contact_normal_x") + impulse("friction_x"), change[0], 1e-9 * weight, f"{law}, {kinematics}: the impulse along")
        near(impulse("contact_normal_y") + impulse("friction_y"), change[1] + weight, 1e-9 * weight, f"{law}, {kinematics}: across")
        near(impulse("friction_x"), change[0], 1e-6 * weight, f"{law}, {kinematics}: that of friction")
        taken = sum(MU * row["block.contact_normal_y"] * row["block.slip_velocity_x"] * (row["time"] - before["time"])
                    for before, row in zip(probes, probes[1:]))
        near(taken / rows[-1]["dissipated"], 1.0, 0.01, f"{law}, {kinematics}: mu N v over D")


@claim
def probes_of_contact_are_bitwise_identical_on_ranks_and_after_a_restart(programs):
    for ranks, law, kinematics in ON_RANKS:
        options = [*with_law(law, kinematics), "--interval", 7, "--set", CONTACT_PROBE]
        whole = run(programs, "block.toml", *options, *keys(run__time=0.04)).require_end()
        expected = (whole.out / "probes.csv").read_bytes()
        if ranks > 1:
            shared = run(programs, "block.toml", *options, *keys(run__time=0.04), "--ranks", ranks).require_end()
            require((shared.out / "probes.csv").read_bytes() == expected, f"{law}, {kinematics}: {ranks} ranks have other bits")
        with tempfile.TemporaryDirectory() as folder:
            part = pathlib.Path(folder) / "part"
            for command in ([programs / "abut", "run", INPUTS / "block.toml", "--frames", "0", *options, *keys(run__time=0.02), "--out",
                             part, "--keep-last-checkpoint"], [programs / "abut", "restart", part, "--until", "0.04"]):
                done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
                require(done.returncode == 0, done.stdout + done.stderr)
            require(whole.rows("probes.csv")[-1] == list(abut_runs.rows_of(part / "probes.csv"))[-1],
                    f"{law}, {kinematics}: a restart has other bits")


@claim
def what_cannot_be_is_refused(programs):
    for options, word in ((keys(contact__friction=-0.1), "contact.friction"),
                          (keys(contact__sliding_friction=0.1), "decay_speed"),
                          (["--set", 'contact.pairs=[{bodies=["block", "roof"], friction=0.1}]'], "roof"),
                          (["--set", 'contact.pairs=[{friction=0.1}]'], "bodies"),
                          (["--integrator", "memm_async", "--kinematics", "small"], "friction"),
                          ([*keys(contact__friction=0), "--integrator", "memm_async", "--kinematics", "rigid"], "local steps"),
                          (["--integrator", "bilbao", "--kinematics", "small"], "friction"),
                          (["--set", 'output.probes.block={body="block", contact=true, point=[0.1, 0.1]}'], "as a whole")):
        done = run(programs, "block.toml", *options)
        require(done.code == 1 and word in done.said, f"{options}: {done.said}")


if __name__ == "__main__":
    sys.exit(main(claim))
