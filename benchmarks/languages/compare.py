"""compare.py <folder> [<file.json>]: what a step of contact costs from C++, C, Fortran and Python.

<folder> has the programs benchmark_step_cost_cxx, _c and _fortran; PYTHONPATH has the module. Two cubes of triangles, one
over the other: far apart, where nothing but the call itself is left; near, where pairs of faces are looked at and none
touches; and pressed together. W of all languages must be the same to the last bit. All run in turn on one processor, again
and again; the least counts.

Expected: C and Fortran cost what C++ costs, within a few hundredths of a microsecond; Python a few microseconds more.
"""
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

import numpy as np

ROUNDS = 9
SCENES = {"far apart": dict(side=1, gaps=(3.0, 3.0, 2.999), calls=200000, pairs=(0, 0)),
          "near": dict(side=1, gaps=(0.5, 0.5, 0.499), calls=10000, pairs=(0, 0)),
          "in contact": dict(side=6, gaps=(0.01, -0.01, -0.012), calls=100, pairs=(300, 400))}


def cube(side, first):
    """Nodes of a unit cube, (side + 1)^3 of them, and the triangles of its surface."""
    grid = np.arange(side + 1)
    nodes = np.stack(np.meshgrid(grid, grid, grid, indexing="ij"), axis=-1).reshape(-1, 3) / side
    triangles = []
    for axis in range(3):
        for up in (0, 1):
            def node(s, t):
                at = [0, 0, 0]
                at[axis], at[(axis + 2 - up) % 3], at[(axis + 1 + up) % 3] = up * side, s, t
                return first + (at[0] * (side + 1) + at[1]) * (side + 1) + at[2]
            for s in range(side):
                for t in range(side):
                    a, b, c, d = node(s, t), node(s + 1, t), node(s + 1, t + 1), node(s, t + 1)
                    triangles += [[a, b, c], [a, c, d]]
    return nodes, triangles


def write_scene(file, side, gaps):
    """int32 nodes and faces, corners and bodies from 0; doubles depths, stiffnesses, positions in three states."""
    turn = np.array([[np.cos(0.3), -np.sin(0.3), 0.0], [np.sin(0.3), np.cos(0.3), 0.0], [0.0, 0.0, 1.0]])
    nodes, lower = cube(side, 0)
    _, upper = cube(side, len(nodes))
    with open(file, "wb") as out:
        np.array([2 * len(nodes), 2 * len(lower)], np.int32).tofile(out)
        np.array(lower + upper, np.int32).tofile(out)
        np.repeat(np.array([0, 1], np.int32), len(lower)).tofile(out)
        np.full(2 * len(lower), 0.5 / side).tofile(out)
        np.array([3.0, 6.0]).tofile(out)
        for gap in gaps:
            np.vstack([nodes, (nodes - 0.5) @ turn.T + [0.5, 0.5, 1.5 + gap]]).tofile(out)


def main(folder, result_file=None):
    programs = {name: [str(pathlib.Path(folder, "benchmark_step_cost_" + suffix))]
                for name, suffix in (("C++", "cxx"), ("C", "c"), ("Fortran", "fortran"))}
    programs["Python"] = [sys.executable, str(pathlib.Path(__file__).with_name("step_cost.py"))]
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # contact takes one thread then
    results = []
    with tempfile.TemporaryDirectory() as scratch:
        for title, scene in SCENES.items():
            file = os.path.join(scratch, "scene")
            write_scene(file, scene["side"], scene["gaps"])
            times, answers = {name: [] for name in programs}, set()
            for _ in range(ROUNDS):
                for name, program in programs.items():
                    command = [*program, file, str(scene["calls"])]
                    microseconds, pairs, energy = subprocess.check_output(command, text=True).split()
                    times[name].append(float(microseconds))
                    answers.add((int(pairs), float(energy)))
            if len(answers) != 1:
                sys.exit(f"{title}: pairs and W differ: {answers}")
            (pairs, energy), = answers
            if not scene["pairs"][0] <= pairs <= scene["pairs"][1] or (energy > 0.0) != (pairs > 0):
                sys.exit(f"{title}: {pairs} active pairs with W = {energy}, {scene['pairs']} are expected")
            for name, samples in times.items():
                results.append(dict(scene=title, faces=24 * scene["side"] ** 2, active_pairs=pairs, language=name,
                                    microseconds=samples))
    print(f"{'scene':12}{'faces':>6}{'active':>8}{'language':>10}{'us per call':>13}{'over C++':>10}{'more, us':>10}")
    least = {(r["scene"], r["language"]): min(r["microseconds"]) for r in results}
    for r in results:
        own, of_cxx = least[r["scene"], r["language"]], least[r["scene"], "C++"]
        print(f"{r['scene']:12}{r['faces']:6}{r['active_pairs']:8}{r['language']:>10}{own:13.3f}{own / of_cxx:10.3f}"
              f"{own - of_cxx:10.3f}")
    if result_file:
        with open(result_file, "w") as out:
            json.dump(dict(machine=platform.platform(), command=sys.argv, results=results), out, indent=1)


if __name__ == "__main__":
    main(*sys.argv[1:])
