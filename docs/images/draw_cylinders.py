#!/usr/bin/python3
"""Draws frames of a 2D run on the deformed mesh, coloured by von Mises stress (needs python3-vtk9 and gnuplot).

    abut run scenes/slipping_cylinders.toml --set values.size=0.05 --frames 41 --out /tmp/slip
    docs/images/draw_cylinders.py /tmp/slip docs/images/slipping_cylinders.png 0 9 15 28
    cp /tmp/slip/energy.svg docs/images/slipping_energy.svg
"""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

SCALE = 3  # drawn larger, then shrunk: no seams between triangles
PALETTE = "0 '#dde7f1', 0.2 '#b0cef2', 0.45 '#5598e7', 0.7 '#256abf', 1 '#0d366b'"
SCRIPT = """
set terminal pngcairo size {width},{height} font "Sans,{font}" background "white"
set output "{picture}"
set multiplot
set size ratio -1
unset border; unset tics; unset key; unset colorbox
set palette defined ({palette})
set cbrange [0:{largest}]
set xrange [{x0}:{x1}]; set yrange [{y0}:{y1}]
set style fill solid noborder
set lmargin 0; set rmargin 0; set bmargin 0; set tmargin 0
{panels}
"""
PANEL = """
set origin {left},0.2; set size {share},0.78
{colorbox}
set label 1 "t = {time:.1f} s" at graph 0.5,0.03 center
plot "{cells}" using 1:2:3 with filledcurves closed fc palette, "{outline}" with lines lw {line} lc rgb "#ffffff"
unset colorbox; unset cblabel
"""
COLORBOX = """
set colorbox horizontal user origin 0.3,0.15 size 0.4,0.03
set cblabel "von Mises stress [Pa]" offset 0,0.4
set cbtics 0,0.03
"""


def frames_of(directory):
    tree = xml.etree.ElementTree.parse(directory / "bodies.pvd")
    return [(float(entry.get("timestep")), directory / entry.get("file")) for entry in tree.iter("DataSet")]


def cells_of(path):
    """Corners at their present place and von Mises stress of every cell."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    displacement = grid.GetPointData().GetArray("displacement")
    stress = grid.GetCellData().GetArray("von Mises [Pa]")

    def corner(point):
        return tuple(grid.GetPoint(point)[i] + displacement.GetTuple(point)[i] for i in (0, 1))

    for i in range(grid.GetNumberOfCells()):
        points = grid.GetCell(i).GetPointIds()
        yield [corner(points.GetId(k)) for k in range(points.GetNumberOfIds())], stress.GetValue(i)


def write_panel(folder, number, cells):
    with open(folder / f"cells{number}.dat", "w") as filled, open(folder / f"outline{number}.dat", "w") as outline:
        for corners, stress in cells:
            closed = corners + corners[:1]
            filled.write("".join(f"{x} {y} {stress}\n" for x, y in closed) + "\n")
            outline.write("".join(f"{x} {y}\n" for x, y in closed) + "\n")


def shrink(large, picture, width, height):
    reader = vtkPNGReader()
    reader.SetFileName(str(large))
    resize = vtkImageResize()
    resize.SetInputConnection(reader.GetOutputPort())
    resize.SetOutputDimensions(width, height, 1)
    writer = vtkPNGWriter()
    writer.SetFileName(str(picture))
    writer.SetInputConnection(resize.GetOutputPort())
    writer.Write()


def draw(directory, picture, chosen):
    frames = frames_of(directory)
    panels = [(frames[i][0], list(cells_of(frames[i][1]))) for i in chosen]
    corners = [corner for _, cells in panels for shape, _ in cells for corner in shape]
    x, y = zip(*corners)
    stresses = sorted(stress for _, cells in panels for _, stress in cells)
    largest = stresses[int(0.998 * len(stresses))]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text = ""
        for number, (time, cells) in enumerate(panels):
            write_panel(folder, number, cells)
            text += PANEL.format(left=number / len(panels), share=1 / len(panels), time=time, cells=f"cells{number}.dat",
                                 outline=f"outline{number}.dat", line=0.25 * SCALE, colorbox=COLORBOX if number == 0 else "")
        width = 330 * len(panels)
        height = int(width / len(panels) * (max(y) - min(y) + 0.35) / (max(x) - min(x) + 0.1) / 0.78)
        (folder / "draw.gp").write_text(SCRIPT.format(
            width=width * SCALE, height=height * SCALE, font=13 * SCALE, picture="large.png", palette=PALETTE, largest=largest,
            x0=min(x) - 0.05, x1=max(x) + 0.05, y0=min(y) - 0.3, y1=max(y) + 0.05, panels=text))
        subprocess.run(["gnuplot", "draw.gp"], cwd=folder, check=True)
        shrink(folder / "large.png", picture, width, height)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    draw(pathlib.Path(sys.argv[1]), sys.argv[2], [int(frame) for frame in sys.argv[3:]])
