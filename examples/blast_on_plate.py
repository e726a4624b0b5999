"""An explosion on a structure: a gas in numpy bends a clamped plate of Abut, which hits a block behind it.

The problem is that of blast_on_plate.cpp. A layer of gas of 1 MPa and 4 kg/m^3 bursts 0.5 m from a plate of laminate (0.4 m, 20 mm,
E = 10 GPa, 1500 kg/m^3, clamped) that closes a channel of air. Rankine and Hugoniot give the pressure of the reflected shock on a
rigid wall, p_5 = 1.171 MPa; the plate closes a gap of 2 mm and hits a free block.

The gas is two-dimensional: fixed squares, first order, HLLC. The plate cuts them along a front x(y), of which only x moves: what is
open of each side over a step, and the area of each cell after it, are integrals in closed form, and the wall's share of each cell is
what closes it in space and time. So mass is exact, and with the work that the plate books, momentum and energy of gas and solids, too.
With the name of a picture (.png, or .gif for a moving one) a disc of gas bursts as well, and is drawn.
"""
import sys

import numpy as np
from abut import solid

GAMMA, P_0 = 1.4, 1e5
HEIGHT, THICKNESS, GAP, DEPTH = 0.4, 0.02, 2e-3, 0.1  # channel, plate, gap, block [m]
FACES, CHARGE_AT = 40, -0.5
ROWS, COLUMNS = 2 * FACES, 160
SIZE = HEIGHT / ROWS  # of the squares [m]
LEFT = 0.02 - COLUMNS * SIZE
AIR, CHARGE = np.array([1.2, 0.0, 0.0, P_0]), np.array([4.0, 0.0, 0.0, 1e6])  # rho, u, v, p


# Gas --------------------------------------------------------------------------------------------------------------------

def sound(state):
    return np.sqrt(GAMMA * state[3] / state[0])


def conserved(state):
    rho, u, v, p = state
    return np.array([rho, rho * u, rho * v, p / (GAMMA - 1.0) + 0.5 * rho * (u**2 + v**2)])


def primitive(content, area):
    mass, x, y, energy = content
    return np.array([mass / area, x / mass, y / mass, (GAMMA - 1.0) * (energy - 0.5 * (x**2 + y**2) / mass) / area])


def flux(state):
    q, u, p = conserved(state), state[1], state[3]
    return np.array([q[1], q[1] * u + p, q[2] * u, (q[3] + p) * u])


def hllc(left, right):
    """Along x, with the speeds of Davis."""
    s_l = np.minimum(left[1] - sound(left), right[1] - sound(right))
    s_r = np.maximum(left[1] + sound(left), right[1] + sound(right))
    m_l, m_r = left[0] * (s_l - left[1]), right[0] * (s_r - right[1])
    s = (right[3] - left[3] + m_l * left[1] - m_r * right[1]) / (m_l - m_r)
    from_left = s >= 0.0
    side, s_k, m = np.where(from_left, left, right), np.where(from_left, s_l, s_r), np.where(from_left, m_l, m_r)
    rho, q = m / (s_k - s), conserved(side)
    star = rho * np.array([np.ones_like(s), s, side[2], q[3] / side[0] + (s - side[1]) * (s + side[3] / m)])
    return flux(side) + np.where(from_left, np.minimum(s_l, 0.0), np.maximum(s_r, 0.0)) * (star - q)


def wall_pressure(state, w):
    """On a piston towards which gas flows with w, relative to it: a shock, or a fan."""
    a, b = sound(state), 0.25 * (GAMMA + 1.0) * w
    fan = np.maximum(0.0, 1.0 + 0.5 * (GAMMA - 1.0) * np.minimum(w, 0.0) / a)**(2.0 * GAMMA / (GAMMA - 1.0))
    return np.where(w > 0.0, state[3] + state[0] * w * (b + np.hypot(b, a)), state[3] * fan)


def positive_part(a, b):
    """Mean of max(f, 0), f from a to b on a line."""
    high, low = np.maximum(a, b), np.minimum(a, b)
    cut = np.maximum(high, 0.0)**2 / np.where(high > low, 2.0 * (high - low), 1.0)
    return np.where(low >= 0.0, 0.5 * (a + b), cut)


def share_above(a, b, c):
    """The part of a triangle on which f > 0, with a, b and c at its corners."""
    a, b, c = np.sort(np.broadcast_arrays(a, b, c), axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        most, least = 1.0 - a**2 / ((b - a) * (c - a)), c**2 / ((c - a) * (c - b))
    return np.where(a >= 0.0, 1.0, np.where(c <= 0.0, 0.0, np.where(b >= 0.0, most, least)))


class Gas:
    """Left of a front that has x at the lines between rows (ROWS + 1)."""

    def __init__(self, front, start):
        self.lines = LEFT + SIZE * np.arange(COLUMNS + 1)
        middle_y, middle_x = np.meshgrid((np.arange(ROWS) + 0.5) * SIZE, self.lines[:-1] + 0.5 * SIZE, indexing="ij")
        self.state = np.moveaxis(start(middle_x, middle_y), -1, 0)
        self.area, self.left = self.areas(front), np.zeros(4)
        self.content = self.area * conserved(self.state)

    def areas(self, front):
        beyond = front[:, None] - self.lines  # of the front, from each line
        return SIZE * -np.diff(positive_part(beyond[:-1], beyond[1:]))

    def stable_step(self):
        full = self.area > 0.5 * SIZE**2
        return 0.3 * SIZE / np.max(np.maximum(abs(self.state[1]), abs(self.state[2]))[full] + sound(self.state)[full])

    def step(self, dt, before, after, velocity):
        """The front moves; `velocity` (ROWS, 2) is that which does work. Returns the impulse on each row of it (ROWS, 2)."""
        f_0, f_1 = before[:, None] - self.lines, after[:, None] - self.lines
        middle = 0.25 * (f_0[:-1] + f_0[1:] + f_1[:-1] + f_1[1:])
        ring = [f_0[:-1], f_1[:-1], f_1[1:], f_0[1:]]
        open_x = 0.25 * SIZE * dt * sum(share_above(ring[k], ring[(k + 1) % 4], middle) for k in range(4))
        open_y = dt * -np.diff(positive_part(f_0, f_1))
        area = self.areas(after)
        wall_x, wall_y = -np.diff(open_x), -np.diff(open_y, axis=0)  # area vectors out of the gas

        turn = [0, 2, 1, 3]
        along_x = np.zeros((4, ROWS, COLUMNS + 1))
        along_x[:, :, 1:-1] = hllc(self.state[:, :, :-1], self.state[:, :, 1:])
        along_x[1, :, 0] = wall_pressure(self.state[:, :, 0], -self.state[1, :, 0])
        along_y = np.zeros((4, ROWS + 1, COLUMNS))
        along_y[:, 1:-1] = hllc(self.state[turn, :-1], self.state[turn, 1:])[turn]
        along_y[2, 0], along_y[2, -1] = (wall_pressure(self.state[:, j], s * self.state[2, j]) for j, s in ((0, -1), (-1, 1)))
        passed_x, passed_y = open_x * along_x, open_y * along_y
        self.content = self.content - np.diff(passed_x) - np.diff(passed_y, axis=1)
        self.left += passed_y[:, -1].sum(axis=1) - passed_y[:, 0].sum(axis=1) - passed_x[:, :, 0].sum(axis=1)

        size = np.hypot(wall_x, wall_y)
        u, v = velocity[:, :1], velocity[:, 1:]
        w = ((self.state[1] - u) * wall_x + (self.state[2] - v) * wall_y) / np.where(size > 0.0, size, 1.0)
        p = wall_pressure(self.state, w)
        self.content[1] -= p * wall_x
        self.content[2] -= p * wall_y
        self.content[3] -= p * (wall_x * u + wall_y * v)
        self.area = area
        self.mix()
        return np.stack([(p * wall_x).sum(axis=1), (p * wall_y).sum(axis=1)], axis=1)

    def mix(self):
        """The last cell of each row that has half of its area takes all that are behind it."""
        last = (self.area >= 0.5 * SIZE**2).sum(axis=1, keepdims=True) - 1
        cut = np.arange(COLUMNS) >= last
        content = np.where(cut, self.content, 0.0).sum(axis=2, keepdims=True)
        area = np.where(cut, self.area, 0.0).sum(axis=1, keepdims=True)
        per_area = np.where(cut, content / area, self.content / np.where(cut, 1.0, self.area))
        self.content = self.area * per_area
        self.state = primitive(per_area, 1.0)

    def sums(self):
        """Mass, momentum and energy, with those that have left through the walls of the channel."""
        return self.content.sum(axis=(1, 2)) + self.left


# Both -------------------------------------------------------------------------------------------------------------------

def layer(x, y):
    return np.where((x < CHARGE_AT)[..., None], CHARGE, AIR)


def disc(x, y):
    return np.where((np.hypot(x - CHARGE_AT, y - 0.5 * HEIGHT) < 0.1)[..., None], CHARGE, AIR)


def front_of(x):
    """At the lines between rows, two of which a face has, from the middles of the faces; 0 at the clamps."""
    corners = np.concatenate([[0.0], 0.5 * (x[:-1] + x[1:]), [0.0]])
    front = np.empty(ROWS + 1)
    front[::2], front[1::2] = corners, 0.5 * (corners[:-1] + corners[1:])
    return front


def blast(start, end, look=lambda *of: None):
    plate = solid.structured_box((0.0, 0.0), (THICKNESS, HEIGHT), (2, FACES), name="plate")
    at = THICKNESS + GAP
    block = solid.structured_box((at, 0.25 * HEIGHT), (at + DEPTH, 0.75 * HEIGHT), (8, 17), name="block")
    mesh = solid.combine([plate, block])
    material = solid.Material(young=1e10, poisson=0.3, density=1500.0)
    run = solid.memm(mesh, [material] * 2, [(0.0, 0.0)] * 2, held={"plate.ymin": (0.0, 0.0), "plate.ymax": (0.0, 0.0)},
                     outside=["plate.xmin"], restart=20)
    clock = run.clock()
    faces = clock.faces("plate.xmin")
    normal, area = faces["normal"], faces["area"]
    order = np.argsort(faces["position"][:, 1])  # from below
    x, gas = np.zeros(FACES), Gas(np.zeros(ROWS + 1), start)
    found = {"start": gas.sums(), "impulse": np.zeros(2), "swept": 0.0, "times": [], "pressures": [], "speeds": [], "steps": 0}
    while clock.time < end or clock.time_to_node < run.dt * (1.0 - 1e-9):  # energies are those of nodes
        look(clock.time, gas, mesh, clock.displacement)
        d = min(gas.stable_step(), clock.time_to_node)
        motion = clock.motion("plate.xmin", d)
        after = x + motion[order, 0]
        impulse = gas.step(d, front_of(x), front_of(after), np.repeat(motion[order] / d, 2, axis=0)).reshape(FACES, 2, 2).sum(axis=1)
        x, pushed = after, np.empty_like(impulse)
        pushed[order] = impulse
        clock.set_traction("plate.xmin", pushed / (area[:, None] * d) + P_0 * normal)  # air is behind the plate, too
        found["times"].append(clock.time + 0.5 * d)
        found["pressures"].append(impulse[:, 0].sum() / (d * HEIGHT))
        found["speeds"].append(motion[:, 0].mean() / d)
        found["impulse"] += impulse.sum(axis=0)
        found["swept"] -= (area * (normal * motion).sum(axis=1)).sum()
        found["steps"] += 1
        clock.advance(d)
    run.record()
    return run, gas, found


def reflected_shock():
    """Of the shock that the layer sends out, on a rigid wall: pressure and rho a behind it, and when it is there."""
    def change(state, p):
        rho, _, _, p_side = state
        if p > p_side:
            return (p - p_side) * np.sqrt(2.0 / (rho * ((GAMMA + 1.0) * p + (GAMMA - 1.0) * p_side)))
        return 2.0 * sound(state) / (GAMMA - 1.0) * ((p / p_side)**(0.5 * (GAMMA - 1.0) / GAMMA) - 1.0)
    low, high = P_0, CHARGE[3]
    for _ in range(100):  # of the middle state of the burst
        p = 0.5 * (low + high)
        low, high = (p, high) if change(AIR, p) + change(CHARGE, p) < 0.0 else (low, p)
    speed = sound(AIR) * np.sqrt(0.5 * (GAMMA + 1.0) / GAMMA * p / P_0 + 0.5 * (GAMMA - 1.0) / GAMMA)
    p_5 = p * ((3.0 * GAMMA - 1.0) * p - (GAMMA - 1.0) * P_0) / ((GAMMA - 1.0) * p + (GAMMA + 1.0) * P_0)
    denser, g = 1.0, (GAMMA - 1.0) / (GAMMA + 1.0)
    for rise in (p / P_0, p_5 / p):
        denser *= (rise + g) / (g * rise + 1.0)
    return p_5, np.sqrt(GAMMA * p_5 * AIR[0] * denser), -CHARGE_AT / speed


def check(start, end):
    """Runs it, and prints what is kept. Returns what was found, and whether that is to round-off."""
    run, gas, found = blast(start, end)
    last, work, sums = run.ledger[-1], run.outside_work, gas.sums()
    mass = sums[0] / found["start"][0] - 1.0
    momentum = np.abs(sums[1:3] + found["impulse"]).max() / (CHARGE[3] * HEIGHT * end)
    of_solids = last["pseudo_energy"] + work["held"] - work["changes"]
    energy = (sums[3] - found["start"][3] + P_0 * found["swept"] + of_solids) / found["start"][3]
    excess = (last["energy"] - last["pseudo_energy"]) / work["steps"]
    speed, missed = run.bodies[1]["velocity"][0], run.contact["missed_contacts"]
    print(f"{run.steps} steps, {found['steps']} of the gas; block {speed:.2f} m/s, {missed} contacts missed\n"
          f"mass {mass:.0e}, momentum {momentum:.0e}, energy {energy:.0e}; H - H~ {excess:.0e} of the work, "
          f"stored {work['changes'] / work['steps']:.0e}")
    return found, max(abs(mass), momentum, abs(energy)) < 1e-12 and missed == 0 and speed > 0.0


# Pictures ---------------------------------------------------------------------------------------------------------------

class Film:
    """Frames of a run at given times: pressures, and cells where they are."""

    def __init__(self, times):
        self.times, self.frames = list(times), []

    def __call__(self, time, gas, mesh, displacement):
        if len(self.frames) < len(self.times) and time >= self.times[len(self.frames)]:
            pressure = np.where(gas.area > 0.5 * SIZE**2, gas.state[3], np.nan)
            self.frames.append((time, pressure, mesh.centroids + displacement, mesh.measures, mesh.body))


def draw(axes, frame):
    from matplotlib.collections import PolyCollection
    time, pressure, centres, areas, body = frame
    axes.clear()
    axes.imshow(1e-6 * pressure, origin="lower", extent=(LEFT, LEFT + COLUMNS * SIZE, 0.0, HEIGHT), cmap="magma", vmin=0.0, vmax=0.7)
    width = np.where(body == 0, THICKNESS / 2, DEPTH / 8)
    half = 0.5 * np.stack([width, areas / width], axis=1)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    axes.add_collection(PolyCollection(centres[:, None] + half[:, None] * corners, facecolor="#8fbce8", edgecolor="#33414f", linewidth=0.2))
    axes.set(xlim=(LEFT, THICKNESS + GAP + DEPTH + 0.02), ylim=(0.0, HEIGHT), title=f"{1e3 * time:.2f} ms", xticks=[], yticks=[])


def picture(path, end):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import animation, pyplot
    moving = path.endswith(".gif")
    film = Film(np.linspace(0.0, end, 61)[:-1] if moving else (0.0, 0.3 * end, 0.55 * end, 0.95 * end))
    blast(disc, end, film)
    if moving:
        figure, axes = pyplot.subplots(figsize=(6.4, 3.0), layout="constrained")
        animation.FuncAnimation(figure, lambda k: draw(axes, film.frames[k]), len(film.frames)).save(
            path, writer=animation.PillowWriter(fps=12), dpi=70)
        return
    figure, panels = pyplot.subplots(2, 2, figsize=(10, 4.7), layout="constrained")
    for axes, frame in zip(panels.flat, film.frames):
        draw(axes, frame)
    figure.colorbar(panels[0, 0].images[0], ax=panels, label="pressure [MPa]")
    figure.savefig(path, dpi=90)


p_5, impedance, arrival = reflected_shock()
found, good = check(layer, arrival + 0.8e-3)
times, pressures, speeds = np.array(found["times"]) - arrival, np.array(found["pressures"]), np.array(found["speeds"])
early = (times > 1e-4) & (times < 3e-4)
error = np.abs(pressures - p_5 + impedance * speeds)[early].mean() / p_5
print(f"p_5 = {1e-6 * p_5:.4f} MPa; |p - (p_5 - Z v)| on the plate {error:.1e} of it, from 0.1 to 0.3 ms after the shock")
if len(sys.argv) > 1:
    picture(sys.argv[1], 2e-3)
sys.exit(0 if good and error < 0.01 else 1)
