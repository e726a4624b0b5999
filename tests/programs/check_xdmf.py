#!/usr/bin/env python3
"""Frames in one file: check_xdmf.py ABUT SCENES. What `output.format = "xdmf"` writes, read by h5py and by meshio, has all values of
the VTU and VTP files of the same run, bitwise; a run that is killed and goes on leaves the same frames, each once; a full disc
leaves those before it; pieces are refused. Needs python3-h5py, python3-meshio and python3-vtk9; exits with 77 where one is missing."""
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time

try:
    import h5py
    import meshio
    import numpy
    from vtkmodules import vtkIOXML
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

ABUT, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
LIMIT = 2_000_000  # bytes of a file
BOXES = """dim = 3
[bodies.lower]
shape = "structured_box"
lower = [0, 0, 0]
upper = [1, 1, 0.5]
counts = [2, 2, 2]
cells = "prism"
young = 1e5
poisson = 0.3
density = 1000
[bodies.upper]
shape = "structured_box"
lower = [0.2, 0.2, 0.501]
upper = [0.8, 0.8, 1]
counts = [2, 2, 2]
young = 1e5
poisson = 0.3
density = 1000
velocity = [0, 0, -1]
[run]
time = 0.1
"""


def run(scene, out, *options):
    command = [ABUT, "run", scene, "--quiet", "--out", out, "--frames", "4", *options]
    return subprocess.run(command, capture_output=True, text=True)


def same(one, two, what):
    one, two = numpy.ascontiguousarray(one, dtype=float).ravel(), numpy.ascontiguousarray(two, dtype=float).ravel()
    assert one.tobytes() == two.tobytes(), f"{what}: {one[:4]} and {two[:4]}"


def in_hdf5(name):
    return name.replace("/", " per ")


def compare(vtu, xdmf):
    frames = sorted(vtu.glob("frames/bodies_0*.vtu"))
    assert len(frames) == 4
    assert not [*xdmf.glob("frames/bodies_0*"), *xdmf.glob("frames/bodies_surface_0*")], "frames of the other format"
    with h5py.File(xdmf / "bodies.h5") as h5, meshio.xdmf.TimeSeriesReader(xdmf / "bodies.xmf") as series:
        assert sorted(h5["frames"]) == [f"{i:06}" for i in range(len(frames))]
        points, cells = series.read_points_cells()
        for i, path in enumerate(frames):
            mesh, group = meshio.read(path), h5[f"frames/{i:06}"]
            moment, point_data, cell_data = series.read_data(i)
            assert moment == group.attrs["time"] == mesh.field_data["TimeValue"][0], moment
            names = [name.decode() if isinstance(name, bytes) else name for name in h5["body"].attrs["names"]]
            assert all(mesh.field_data[f"body: {name}"][0] == k for k, name in enumerate(names)), names
            same(points, mesh.points, "points")
            same(h5["points"], mesh.points, "points")
            assert [block.type for block in cells] == [block.type for block in mesh.cells]
            for block, other in zip(cells, mesh.cells):
                if block.type != "wedge":  # which meshio reads in an order of its own from VTU
                    same(block.data, other.data, "cells")
            assert set(point_data) == set(mesh.point_data) and set(cell_data) == set(mesh.cell_data), (cell_data, mesh.cell_data)
            for name, values in mesh.point_data.items():
                same(point_data[name], values, name)
            for name, blocks in mesh.cell_data.items():
                same(numpy.concatenate(cell_data[name]), numpy.concatenate(blocks), name)
                same(h5["body"] if name == "body" else group["cells"][in_hdf5(name)], numpy.concatenate(blocks), name)
            surface(path.with_name(path.name.replace("bodies_", "bodies_surface_").replace(".vtu", ".vtp")), h5, i)
    with meshio.xdmf.TimeSeriesReader(xdmf / "bodies_surface.xmf") as series:
        series.read_points_cells()
        assert "contact pressure [Pa]" in series.read_data(3)[2]
    assert (vtu / "energy.csv").read_bytes() == (xdmf / "energy.csv").read_bytes()


def surface(path, h5, i):
    reader = vtkIOXML.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data, group = reader.GetOutput().GetCellData(), h5[f"frames/{i:06}/faces"]
    assert data.GetNumberOfArrays() == len(group) + 1 + len(h5["groups"])
    for name in (data.GetArrayName(k) for k in range(data.GetNumberOfArrays())):
        of = h5["face_body"] if name == "body" else h5["groups"][name[7:]] if name.startswith("group: ") else group[in_hdf5(name)]
        same(of, vtk_to_numpy(data.GetArray(name)), name)
    place, vertices = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()), h5["points"][()]
    corners = []
    for k in range(reader.GetOutput().GetNumberOfCells()):
        ids = reader.GetOutput().GetCell(k).GetPointIds()
        corners.append([place[ids.GetId(j)] for j in range(ids.GetNumberOfIds())])
    faces, at = [], 0
    if h5["faces"].ndim == 2:
        faces = list(h5["faces"][()])
    else:
        numbers = h5["faces"][()]
        while at < len(numbers):
            n = {4: 3, 5: 4}[numbers[at]]
            faces.append(numbers[at + 1 : at + 1 + n])
            at += 1 + n
    assert len(faces) == len(corners)
    for face, of_vtp in zip(faces, corners):
        same(vertices[face], of_vtp, "corners of a face")


def all_arrays(path):
    arrays = {}
    with h5py.File(path) as h5:
        h5.visititems(lambda name, item: arrays.update({name: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None)
    return arrays


def check_full_disc(folder):
    """Where there is no more space a run ends with a message, and the frames before that are there."""
    def limited():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))

    out = folder / "full"
    command = [ABUT, "run", SCENES / "slipping_cylinders.toml", "--quiet", "--format", "xdmf", "--frames", "200", "--out", out]
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limited)
    assert done.returncode == 1 and "bodies.h5" in done.stderr and "File too large" in done.stderr, done
    with h5py.File(out / "bodies.h5") as h5, meshio.xdmf.TimeSeriesReader(out / "bodies.xmf") as series:
        assert 1 < len(h5["frames"]) == series.num_steps < 200
        assert (out / "bodies.h5").stat().st_size < LIMIT
        series.read_points_cells()
        for i in range(series.num_steps):
            assert "von Mises [Pa]" in series.read_data(i)[2]


def check_restart(folder):
    """A run is killed again and again, behind a checkpoint and frames that come after it, and goes on. All its frames can be read in
    between."""
    options = ["--set", "run.time=60", "--set", "output.frames=200", "--set", "output.checkpoint_steps=50", "--set", "output.format=xdmf"]
    command = [ABUT, "run", SCENES / "slipping_cylinders.toml", "--quiet", *options, "--out"]
    subprocess.run([*command, folder / "whole"], check=True)
    stopped = folder / "stopped"
    process = subprocess.Popen([*command, stopped])
    while process.poll() is None and not list(stopped.glob("checkpoints/*.h5")):
        time.sleep(0.01)
    process.kill()
    assert process.wait() == -signal.SIGKILL, "the run has come to its end"
    kills = 1
    for moment in range(1, 6):
        n_frames = len(all_arrays(stopped / "bodies.h5"))
        try:
            done = subprocess.run([ABUT, "restart", stopped, "--quiet"], capture_output=True, text=True, timeout=0.13 * moment)
            assert done.returncode == 0, done.stderr
            break
        except subprocess.TimeoutExpired:  # run has killed it
            kills += 1
        assert n_frames > 0
    else:
        subprocess.run([ABUT, "restart", stopped, "--quiet"], check=True)
    assert kills > 1, "no restart was killed"
    for name in ("bodies.xmf", "bodies_surface.xmf"):
        assert (stopped / name).read_bytes() == (folder / "whole" / name).read_bytes(), name
    assert all_arrays(stopped / "bodies.h5") == all_arrays(folder / "whole" / "bodies.h5")


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "boxes.toml").write_text(BOXES)
    for scene, options in ((SCENES / "slipping_cylinders.toml", ["--set", "values.size=0.25", "--steps", "12"]),
                           (folder / "boxes.toml", [])):
        vtu, xdmf = folder / f"{scene.stem}_vtu", folder / f"{scene.stem}_xdmf"
        for out, more in ((vtu, []), (xdmf, ["--format", "xdmf"])):
            done = run(scene, out, *options, *more)
            assert done.returncode == 0, done.stderr
        compare(vtu, xdmf)
    check_restart(folder)
    check_full_disc(folder)
    refused = run(SCENES / "slipping_cylinders.toml", folder / "pieces", "--format", "xdmf", "--pieces")
    assert refused.returncode == 1 and "--pieces" in refused.stderr and "vtu alone" in refused.stderr, refused.stderr
