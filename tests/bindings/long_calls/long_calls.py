"""long_calls.py [rounds]: as long_calls.c, from Python, where reference counts may leak as well."""
import sys

import numpy as np

import abut

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
CORNERS = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])


def own_memory():
    """[kB] without pages of libraries, from the page tables."""
    with open("/proc/self/smaps_rollup") as rollup:
        return next(int(line.split()[1]) for line in rollup if line.startswith("Anonymous:"))


def placed(by, aside=0.0):
    return np.vstack([SQUARE, SQUARE + [0.2 + aside, 1.1 - by]])


def made():
    contact = abut.NodalContact(at[2], np.vstack([CORNERS, CORNERS + 4]), np.repeat([0, 1], 4), np.full(8, 0.1), [3.0, 6.0],
                                friction=0.3, shear_stiffness=[1.0, 2.0], law_of=lambda face_1, face_2: 0,
                                own_coefficient=lambda speed, slid, pressure: 0.25, wanted=lambda face_1, face_2: True, log=lambda severity, text: None)
    contact.step(1.0, at[2], at[0])
    return contact


rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 1000000
warm_up = rounds // 2  # the interpreter's lists of free objects grow for a while
part = (rounds - warm_up) // 4  # a leak shows in each of four parts, a heap that takes another page or two in one
at = [placed(0.13), placed(0.15, aside=0.05), placed(0.0), placed(-0.9, aside=0.05)]
broken = placed(0.0)
broken[5, 1] = np.nan
force = np.zeros((8, 2))
pairs = faces = refused = 0
memory = []
for i in range(rounds):
    if i >= warm_up and (i - warm_up) % part == 0:
        memory.append(own_memory())
    if i % 100 == 0:
        contact = made()
    if i % 10 == 9:
        try:
            contact.step(1.0, at[i % 4], broken, out=force)
        except abut.Diverged:
            refused += 1
    contact.step(1.0, at[i % 4], at[(i + 1) % 4], out=force)
    pairs += len(contact.pairs)
    faces += len(contact.friction)
    state, missed = contact.state(), contact.report["missed_contacts"]
    if missed:
        sys.exit(f"round {i}: {missed} missed")
    if i % 10 == 9:
        contact.restore(state)
memory.append(own_memory())
growth = min(after - before for before, after in zip(memory, memory[1:]))
print(f"{rounds} rounds, {pairs} pairs, {faces} faces with friction, {refused} refused: {memory} kB from round {warm_up} on")
sys.exit(refused != rounds // 10 or pairs <= rounds // 2 or faces <= rounds // 2 or (rounds >= 100000 and growth > 4))
