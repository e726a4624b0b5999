"""compare_runs.py <abut>: a run of scenes/slipping_cylinders.toml by that program and the same one by abut.solid, in turn; the least of five counts.

Meshes and output are left out of both. The velocities at the end must have the same bits.

Expected: the same time, since the interpreter only begins the run and ends it.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from abut import solid

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "slipping_cylinders.toml"

x, y = 0.5 * math.sqrt(2.02**2 - 0.8**2), 0.4
mesh = solid.combine([solid.disc(centre=(-x, -y), size=0.03, name="left"),
                      solid.disc(centre=(x, y), size=0.03, variant=1, name="right")])
seconds = {"program": [], "Python": []}
with tempfile.TemporaryDirectory() as out:
    for _ in range(5):
        subprocess.run([sys.argv[1], "run", SCENE, "--set", "values.size=0.03", "--steps", "1000", "--interval", "10",
                        "--frames", "0", "--out", out], check=True, capture_output=True)
        summary = json.loads(pathlib.Path(out, "summary.json").read_text(encoding="utf-8"))
        of_program = summary["seconds"]
        seconds["program"].append(of_program["total"] - of_program["mesh"] - of_program["output"])
        result = solid.simulate(mesh, [solid.Material()] * 2, [(0.05, 0.0), (-0.05, 0.0)], steps=1000, interval=10)
        seconds["Python"].append(result["seconds"])
for name, taken in seconds.items():
    print(f"{name:8} {min(taken):.2f} s   {min(taken) / min(seconds['program']):.2f}")
print(f"{len(mesh.measures)} cells, {result['steps']} steps, left disc {result['end'][0]['velocity']}")
if any(list(motion["velocity"]) != body["velocity_final"] for motion, body in zip(result["end"], summary["bodies"])):
    sys.exit("the two runs differ")
