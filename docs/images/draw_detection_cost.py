#!/usr/bin/env python3
"""Draws docs/images/detection_cost.png from a result of benchmark_detection:

benchmark_detection --faces 1000,3000,10000,30000,100000,300000,1000000,3000000 --repetitions 2 --steps 0 --memory 0 \
    --only packed_tree,embree,fcl,rtcCollide,box_intersection_d,AABB_tree --json cost.json
docs/images/draw_detection_cost.py cost.json docs/images/detection_cost.png
"""
import json
import math
import subprocess
import sys

COLOURS = {"packed_tree": "#2a78d6", "embree": "#1f9e6e", "fcl": "#8a5cc2", "rtcCollide": "#eb6834",
           "box_intersection_d": "#b08a00", "AABB_tree": "#c23b5a"}
OURS = ("packed_tree", "embree", "fcl")
TITLES = {"press": "line contact", "plug": "conforming contact"}


def data_block(results, scene, finder):
    rows = [(r["triangles"], r["static"][finder]["ms"]) for r in results if r["scene"] == scene and finder in r["static"]]
    return "\n".join(f"{n} {ms}" for n, ms in sorted(rows))


def law(results, scene):
    """n log n + pairs, through the largest size of the packed tree."""
    rows = sorted((r["triangles"], r["static"]["packed_tree"]) for r in results if r["scene"] == scene)
    work = [(n, n * math.log2(n) + 10.0 * entry["pairs"]) for n, entry in rows]
    scale = rows[-1][1]["ms"] / work[-1][1]
    return "\n".join(f"{n} {scale * w}" for n, w in work)


def main(source, target):
    results = json.load(open(source))["results"]
    finders = list(results[0]["static"])
    script = ["set terminal pngcairo size 1200,520 font 'sans,11'", f"set output '{target}'",
              "set multiplot layout 1,2 margins 0.06,0.985,0.12,0.92 spacing 0.07,0", "set logscale xy", "set xrange [700:4.5e6]", "set grid lw 0.5",
              "set key top left", "set format x '10^{%L}'", "set format y '10^{%L}'", "set xlabel 'triangles a body'",
              "set ylabel 'one query from nothing [ms]'"]
    for scene, title in TITLES.items():
        plots = []
        for finder in sorted(finders, key=list(COLOURS).index):
            name = f"${scene}_{finder}"
            script.append(f"{name} << EOD\n{data_block(results, scene, finder)}\nEOD")
            style = "lw 2.5 pt 7" if finder in OURS else "lw 1.2 pt 6 dt 2"
            plots.append(f"{name} with linespoints {style} lc rgb '{COLOURS[finder]}' title '{finder}' noenhanced")
        script.append(f"$law_{scene} << EOD\n{law(results, scene)}\nEOD")
        plots.append(f"$law_{scene} with lines lw 1 dt 3 lc rgb '#1b1b1a' title 'n log n + pairs'")
        script.append(f"set title '{title}'")
        script.append("plot " + ", ".join(plots))
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


if __name__ == "__main__":
    main(*sys.argv[1:3])
