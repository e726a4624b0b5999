"""A weak shock in air throws a plate (Taylor 1941): a fluid code in numpy drives a solid of Abut.

A shock that raises the pressure by dp = 100 Pa meets a plate of m = 0.5 kg/m^2 that may fly. It feels 2 dp at once, and gives way:
p - p_0 = 2 dp exp(-t/T) and v = 2 dp/(rho a) (1 - exp(-t/T)) with T = m/(rho a), to first order in dp/p_0 = 1e-3. The gas is
one-dimensional (finite volumes, minmod slopes, HLLC, Heun's method, cells that move with the plate), the plate elastic.
"""
import sys

import numpy as np
from abut import solid

GAMMA, P_0, RHO_0, DP = 1.4, 1e5, 1.2, 100.0
TUBE, SHOCK_AT, CELLS = 0.8, -0.05, 400  # the gas fills [-TUBE, 0] [m]
THICKNESS, DENSITY = 0.01, 50.0
A_0 = np.sqrt(GAMMA * P_0 / RHO_0)


def behind_shock():
    """Density, velocity and pressure: Rankine and Hugoniot."""
    m2 = 1.0 + (GAMMA + 1.0) / (2.0 * GAMMA) * DP / P_0
    return np.array([RHO_0 * (GAMMA + 1.0) * m2 / ((GAMMA - 1.0) * m2 + 2.0),
                     2.0 * A_0 / (GAMMA + 1.0) * (np.sqrt(m2) - 1.0 / np.sqrt(m2)), P_0 + DP])


def conserved(state):
    rho, u, p = state
    return np.array([rho, rho * u, p / (GAMMA - 1.0) + 0.5 * rho * u**2])


def hllc(left, right, w):
    """Fluxes of mass, momentum and energy across faces that move with w; no wave is faster than a face here."""
    (rho_l, u_l, p_l), (rho_r, u_r, p_r) = left, right
    a_l, a_r = np.sqrt(GAMMA * p_l / rho_l), np.sqrt(GAMMA * p_r / rho_r)
    s_l, s_r = np.minimum(u_l - a_l, u_r - a_r), np.maximum(u_l + a_l, u_r + a_r)
    m_l, m_r = rho_l * (s_l - u_l), rho_r * (s_r - u_r)
    s = (p_r - p_l + m_l * u_l - m_r * u_r) / (m_l - m_r)
    from_left = s >= w
    rho, u, p = np.where(from_left, left, right)
    s_k, m = np.where(from_left, s_l, s_r), np.where(from_left, m_l, m_r)
    p_star = p + m * (s - u)
    energy = ((s_k - u) * conserved((rho, u, p))[2] - p * u + p_star * s) / (s_k - s)
    density = m / (s_k - s)
    return np.array([density * (s - w), density * s * (s - w) + p_star, energy * (s - w) + p_star * s])


class Gas:
    def __init__(self):
        self.width, self.wall, self.inflow = TUBE / CELLS, 0.0, np.zeros(3)
        behind = np.clip((SHOCK_AT + TUBE) / self.width - np.arange(CELLS), 0.0, 1.0)
        states = [conserved(state)[:, None] for state in (behind_shock(), (RHO_0, 0.0, P_0))]
        self.content = self.width * (behind * states[0] + (1.0 - behind) * states[1])  # mass, momentum, energy of each cell

    def add_fluxes(self, dt, speed):
        rho, momentum, energy = self.content / self.width
        u = momentum / rho
        state = np.array([rho, u, (GAMMA - 1.0) * (energy - 0.5 * momentum * u)])
        mirrored = state[:, -1] * [1, -1, 1] + [0, 2.0 * speed, 0]
        jumps = np.diff(np.column_stack([behind_shock(), state, mirrored]))
        before, after = jumps[:, :-1], jumps[:, 1:]
        half = 0.5 * np.where(before * after > 0.0, np.where(np.abs(before) < np.abs(after), before, after), 0.0)
        last = state[:, -1] + half[:, -1]
        left = np.column_stack([behind_shock(), state + half])
        right = np.column_stack([state - half, last * [1, -1, 1] + [0, 2.0 * speed, 0]])
        flux = hllc(left, right, speed * np.arange(CELLS + 1) / CELLS)
        flux[:, -1] = 0.0, flux[1, -1], flux[1, -1] * speed  # a wall: nothing passes, p does work
        self.content = self.content - dt * np.diff(flux)
        self.inflow += 0.5 * dt * flux[:, 0]
        return flux[1, -1]

    def step(self, dt, motion):
        """The wall moves by `motion`; returns the mean pressure on it."""
        start = self.content
        p = self.add_fluxes(dt, motion / dt)
        self.wall += motion
        self.width = (TUBE + self.wall) / CELLS
        p = 0.5 * (p + self.add_fluxes(dt, motion / dt))
        self.content = 0.5 * (start + self.content)
        return p


plate = solid.structured_box((0.0, 0.0), (THICKNESS, THICKNESS / 2), (4, 2), name="plate")
material = solid.Material(young=1e8, poisson=0.3, density=DENSITY)
run = solid.memm(plate, [material], [(0.0, 0.0)], rollers=["ymin", "ymax"], outside=["xmin"], restart=20)
gas = Gas()
mass, energy, height = gas.content[0].sum(), gas.content[2].sum(), THICKNESS / 2
arrival, period = -SHOCK_AT / A_0, DENSITY * THICKNESS / (RHO_0 * A_0)
times, pressures, speeds = [], [], []
while run.time < arrival + 1.2 * period:
    faces = run.faces("xmin")
    p = gas.step(run.dt, faces["motion"][:, 0].mean())
    run.set_traction("xmin", -(p - P_0) * faces["normal"])  # P_0 acts behind the plate, too
    times.append(run.time + 0.5 * run.dt - arrival)
    run.step()
    pressures.append(p - P_0)
    speeds.append(run.bodies[0]["velocity"][0])
run.record()

times, last, work = np.array(times), run.ledger[-1], run.outside_work
decay = np.exp(-np.maximum(times, 0.0) / period)
exact_speed = 2.0 * DP / (RHO_0 * A_0) * (1.0 - decay)
later = times > 0.05 * period
pressure_error = np.mean(np.abs(np.array(pressures) - 2.0 * DP * decay)[later]) / (2.0 * DP)
speed_error = np.mean(np.abs(speeds - exact_speed)[later]) / exact_speed[-1]
mass_defect = (gas.content[0].sum() - gas.inflow[0] - mass) / mass
of_gas = height * (gas.content[2].sum() - gas.inflow[2] - energy + P_0 * gas.wall)
energy_defect = (of_gas + last["pseudo_energy"] + work["held"] - work["changes"]) / work["steps"]
print(f"{len(times)} steps, T = {1e3 * period:.3f} ms, speed at the end {speeds[-1]:.4f} m/s ({exact_speed[-1]:.4f})")
print(f"mean error of p {pressure_error:.1e}, of v {speed_error:.1e}; mass {mass_defect:.0e}, coupled energy {energy_defect:.0e}, "
      f"H - H~ {(last['energy'] - last['pseudo_energy']) / work['steps']:.0e}, stored {work['changes'] / work['steps']:.0e} "
      f"of the work, |e|/m {last['parasitic'] / speeds[-1]:.0e} v")
# The energy of the gas is 7e6 times the work, and rounded to 1e-16.
good = pressure_error < 0.005 and speed_error < 0.005 and abs(mass_defect) < 1e-12 and abs(energy_defect) < 1e-8
sys.exit(0 if good else 1)
