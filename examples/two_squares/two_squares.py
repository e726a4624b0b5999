"""Contact in a solver of one's own, in Python: two squares of four nodes each run into each other and part."""
import numpy as np

import abut

# Two unit squares, 0.05 m apart; faces run so that their body lies to the left
rest = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (1.05, 0.1), (2.05, 0.1), (2.05, 1.1), (1.05, 1.1)])
faces = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
depth = np.full(8, 0.5)                  # [m] half the height of the element behind a face
k = abut.skin_stiffness(1.0, depth)      # lambda + 2 mu = 1 Pa
contact = abut.NodalContact(rest, faces, body=np.repeat([0, 1], 4), depth=depth, stiffness=[k, k])

mass = np.full(8, 0.25)                      # [kg/m] of each node
dt = contact.stable_step(mass, 2.0)["dt"]    # 2 rad/s: the fastest swing of a square alone
x_0, v = rest, np.repeat([(0.1, 0.0), (-0.1, 0.0)], 4, axis=0)
for step in range(int(np.ceil(4.0 / dt))):
    force = np.zeros((8, 2))
    x_1 = x_0 + dt * v
    contact.step(dt, x_0, x_1, out=force, mode="end")    # all there is to contact
    u = (x_1 - rest).reshape(2, 4, 2)
    force -= (u - u.mean(axis=1, keepdims=True)).reshape(8, 2)    # your elements: here springs to the mean motion
    v = v + dt / mass[:, None] * force
    x_0 = x_1
left, right = v[:4].mean(axis=0), v[4:].mean(axis=0)
print(f"left ({left[0]:.3f}, {left[1]:.3f}), right ({right[0]:.3f}, {right[1]:.3f}), "
      f"missed contacts: {contact.report['missed_contacts']}")
