#include "abut/run/files/paraview_script.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace abut::run {
namespace {

constexpr const char* script = R"py("""Opens the results beside this file in ParaView: paraview --script=view_in_paraview.py

Left the von Mises stress of the cells, right the contact pressure on the boundary, both on bodies as they have moved; there
also the pairs of faces that push each other, as points with the force between them. Obstacles are grey.
"""
import os

from paraview import simple

FOLDER = os.path.dirname(os.path.abspath(__file__))
SERIES = {}
LISTS = {}


def show(view, file_name, field):
    """Shows a series, warped by its displacement and coloured by a field of its cells."""
    path = os.path.join(FOLDER, file_name)
    reader = simple.PVDReader(FileName=path) if LISTS == ".pvd" else simple.Xdmf3ReaderS(FileName=[path])
    moved = simple.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=1.0)
    display = simple.Show(moved, view)
    simple.ColorBy(display, ("CELLS", field))
    display.RescaleTransferFunctionToDataRangeOverTime()
    display.SetScalarBarVisibility(view, True)


def show_pairs(view, file_name):
    """Shows where faces push each other, if the run has left that."""
    path = os.path.join(FOLDER, file_name)
    if not os.path.exists(path):
        return
    display = simple.Show(simple.PVDReader(FileName=path), view)
    display.SetRepresentationType("Points")
    display.PointSize = 6.0
    simple.ColorBy(display, ("POINTS", "normal force [N]"))


def show_obstacles(view, file_name):
    """Shows obstacles where they are, if the run has any."""
    path = os.path.join(FOLDER, file_name)
    if os.path.exists(path):
        simple.Show(simple.PVDReader(FileName=path), view).DiffuseColor = [0.6, 0.6, 0.6]


layout = simple.CreateLayout("Abut")
stress = simple.CreateView("RenderView")
pressure = simple.CreateView("RenderView")
simple.AssignViewToLayout(view=stress, layout=layout)
layout.SplitViewHorizontal(stress, 0.5)
simple.AssignViewToLayout(view=pressure, layout=layout)
show(stress, SERIES + LISTS, "von Mises [Pa]")
show(pressure, SERIES + "_surface" + LISTS, "contact pressure [Pa]")
show_pairs(pressure, SERIES + "_pairs.pvd")
for view in (stress, pressure):
    simple.ResetCamera(view)  # on the bodies
    show_obstacles(view, SERIES + "_obstacles.pvd")
simple.AddCameraLink(stress, pressure, "both")
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
simple.RenderAllViews()
)py";

}  // namespace

std::string paraview_script(const std::string& series, const std::string& extension) {
    std::string text = script;
    const auto put = [&text](const std::string& name, const std::string& value) {
        const std::string empty = name + " = {}";
        text.replace(text.find(empty), empty.size(),
                     name + " = " + nlohmann::json(value).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
    };
    put("SERIES", series);
    put("LISTS", extension);
    return text;
}

}  // namespace abut::run
