"""check_paraview_script.py ABUT SCENE: runs a small scene and then the script that it leaves for ParaView, with a stand-in for
ParaView that knows the functions that the script may call. What the script opens has to be there, with the arrays that it asks for."""
import pathlib
import re
import runpy
import subprocess
import sys
import tempfile
import types

seen = {"readers": [], "fields": [], "warped": [], "views": 0}


class Reader:
    def __init__(self, file_name):
        self.path = pathlib.Path(file_name)
        frames = re.findall(r'file="([^"]+)"', self.path.read_text())
        assert frames, file_name
        self.head = (self.path.parent / frames[0]).read_bytes().split(b"<AppendedData")[0].decode(errors="replace")

    def has(self, place, name):
        part = re.search(rf"<{place}[ >].*?</{place}>", self.head, re.S).group()
        return f'Name="{name}"' in part


class Display:
    def __init__(self, source):
        self.source = source

    def RescaleTransferFunctionToDataRangeOverTime(self):
        pass

    def SetScalarBarVisibility(self, view, visible):
        assert visible

    def SetRepresentationType(self, name):
        assert name == "Points"


class Layout:
    def SplitViewHorizontal(self, view, fraction):
        assert 0.0 < fraction < 1.0


def pvd_reader(FileName):
    seen["readers"].append(Reader(FileName))
    return seen["readers"][-1]


def warp_by_vector(Input, Vectors, ScaleFactor):
    place, name = Vectors
    assert place == "POINTS" and Input.has("PointData", name), Vectors
    assert ScaleFactor == 1.0
    seen["warped"].append(Input)
    return Input


def color_by(display, value):
    place, name = value
    assert place in ("CELLS", "POINTS")
    assert display.source.has("CellData" if place == "CELLS" else "PointData", name), value
    seen["fields"].append(name)


def create_view(kind):
    assert kind == "RenderView"
    seen["views"] += 1
    return object()


simple = types.ModuleType("paraview.simple")
simple.PVDReader = pvd_reader
simple.WarpByVector = warp_by_vector
simple.ColorBy = color_by
simple.CreateView = create_view
simple.CreateLayout = lambda name: Layout()
simple.AssignViewToLayout = lambda view, layout: None
simple.Show = lambda source, view: Display(source)
simple.ResetCamera = lambda view: None
simple.AddCameraLink = lambda first, second, name: None
simple.GetAnimationScene = lambda: types.SimpleNamespace(UpdateAnimationUsingDataTimeSteps=lambda: None)
simple.RenderAllViews = lambda: None
paraview = types.ModuleType("paraview")
paraview.simple = simple
sys.modules.update({"paraview": paraview, "paraview.simple": simple})

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], "run", sys.argv[2], "--set", "values.size=0.25", "--steps", "4", "--frames", "2", "--quiet", "--out", folder], check=True)
    runpy.run_path(folder + "/view_in_paraview.py")
    assert len(seen["warped"]) == seen["views"] == 2
    assert {reader.path.name for reader in seen["readers"]} == {"bodies.pvd", "bodies_surface.pvd", "bodies_pairs.pvd"}
    assert seen["fields"] == ["von Mises [Pa]", "contact pressure [Pa]", "normal force [N]"]
