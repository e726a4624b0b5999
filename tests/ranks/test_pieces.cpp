// Frames that each rank writes its own cells of.
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "abut/run/frames.hpp"
#include "ranks/scenes.hpp"
#include "ranks/shared_run.hpp"

using namespace abut;

namespace {

namespace fs = std::filesystem;

/// All that a file shows of a cell: its arrays, then the positions and arrays of its corners.
using Cell = std::map<std::string, std::vector<double>>;

/// By the number in array `number`; without it by the order in the file.
template <class Reader>
std::map<int, Cell> cells_of(const fs::path& path, const char* number) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkDataSet& grid = *reader->GetOutput();
    std::map<int, Cell> cells;
    vtkDataArray* numbers = grid.GetCellData()->GetArray(number);
    const auto append = [](std::vector<double>& values, vtkDataArray& array, vtkIdType tuple) {
        for (int k = 0; k < array.GetNumberOfComponents(); ++k) values.push_back(array.GetComponent(tuple, k));
    };
    for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
        Cell& cell = cells[numbers ? static_cast<int>(numbers->GetTuple1(c)) : static_cast<int>(c)];
        for (int i = 0; i < grid.GetCellData()->GetNumberOfArrays(); ++i) {
            vtkDataArray& array = *grid.GetCellData()->GetArray(i);
            if (std::string(array.GetName()) != number) append(cell[array.GetName()], array, c);
        }
        vtkNew<vtkIdList> corners;
        grid.GetCellPoints(c, corners);
        for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
            const vtkIdType point = corners->GetId(k);
            for (int j = 0; j < 3; ++j) cell["corners"].push_back(grid.GetPoint(point)[j]);
            append(cell["displacement of corners"], *grid.GetPointData()->GetArray("displacement"), point);
        }
    }
    return cells;
}

bool same(const std::map<int, Cell>& a, const std::map<int, Cell>& b) {
    if (a.size() != b.size() || a.empty()) return false;
    for (const auto& [number, cell] : a) {
        if (!b.contains(number) || b.at(number).size() != cell.size()) return false;
        for (const auto& [name, values] : cell)
            if (!b.at(number).contains(name) || !test::same_bits(values, b.at(number).at(name))) return false;
    }
    return true;
}

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

template <int Dim>
void check_pieces(const run::Scene<Dim>& scene, int steps, const fs::path& folder) {
    const ranks::Communicator all = test::world();
    const run::RunOptions options{.steps = steps, .threads = 1, .rebalance = 4, .rebalance_above = 1.0, .interval = 10};
    if (all.rank() == 0) fs::remove_all(folder);
    all.agree(nullptr);
    const test::SharedMesh<Dim> mesh(all, scene.mesh, test::odd(all, scene.mesh), scene.solid.kinematics);
    run::Frames<Dim> of_first(folder / "pieces", "bodies", 4, true);
    run::PieceFiles<Dim> of_others(folder / "pieces", "bodies", scene.outputs.fields);
    run::Observer<Dim>& mine = all.rank() == 0 ? static_cast<run::Observer<Dim>&>(of_first) : of_others;
    static_cast<void>(run::simulate<Dim>(scene, options, mine, nullptr, mesh.share()));
    bool good = true;
    if (all.rank() == 0) {
        run::Frames<Dim> whole(folder / "whole", "bodies", 4);
        static_cast<void>(run::simulate<Dim>(scene, options, whole));
        for (int frame = 0; frame < 4; ++frame) {
            const std::string name = "bodies_00000" + std::to_string(frame);
            CAPTURE(name);
            good = good && fs::exists(folder / "pieces" / (name + "_" + std::to_string(all.size() - 1) + ".vtu"));
            good = good && same(cells_of<vtkXMLUnstructuredGridReader>(folder / "whole" / (name + ".vtu"), "cell"),
                                cells_of<vtkXMLPUnstructuredGridReader>(folder / "pieces" / (name + ".pvtu"), "cell"));
            const std::string surface = "bodies_surface_00000" + std::to_string(frame);
            good = good && same(cells_of<vtkXMLPolyDataReader>(folder / "whole" / (surface + ".vtp"), "face"),
                                cells_of<vtkXMLPPolyDataReader>(folder / "pieces" / (surface + ".pvtp"), "face"));
            CHECK(good);
        }
        CHECK(text_of(folder / "pieces" / "bodies.pvd").find("bodies_000003.pvtu") != std::string::npos);
        CHECK(text_of(folder / "pieces" / "bodies_surface.pvd").find("bodies_surface_000003.pvtp") != std::string::npos);
        CHECK(fs::exists(folder / "pieces" / "bodies_pairs_000003.vtp") == (scene.contact && scene.outputs.fields.pairs));
    }
    REQUIRE(test::everywhere(all, good));
}

fs::path results(const std::string& name) {
    return fs::path(ABUT_RANKS_RESULTS) / (name + "_" + std::to_string(test::world().size()));
}

}  // namespace

TEST_CASE("frames in pieces hold, cell by cell, what the whole holds", "[ranks][run][pieces]") {
    auto scene = test::meeting_bodies<2>(0.3);
    check_pieces<2>(scene, 15, results("discs"));
}

TEST_CASE("frames in pieces of floating and of rigid bodies hold what the whole holds, also where a rank has no cells",
          "[ranks][run][pieces]") {
    auto scene = test::meeting_bodies<2>(0.3);
    scene.solid.kinematics = {solid::Kinematics::floating, solid::Kinematics::rigid};
    if (GENERATE(false, true)) std::swap(scene.solid.kinematics[0], scene.solid.kinematics[1]);
    scene.added_velocity = [](const Vector<2>& x) -> Vector<2> { return 0.3 * Vector<2>(-x[1], x[0]); };
    check_pieces<2>(scene, 15, results("turning"));
}

TEST_CASE("frames in pieces of a body that flies off hold what the whole holds, also where a rank has no cells",
          "[ranks][run][pieces]") {
    auto scene = test::meeting_bodies<2>(0.3);
    scene.solid.kinematics = {solid::Kinematics::floating, solid::Kinematics::floating};
    scene.contact = false;
    scene.velocity.assign(2, Vector<2>(-20.0, -10.0));
    scene.added_velocity = [](const Vector<2>& x) -> Vector<2> { return 2.0 * Vector<2>(-x[1], x[0]); };
    check_pieces<2>(scene, 15, results("flying"));
}

TEST_CASE("the same in space, where vertices have cells of many ranks around them", "[ranks][run][pieces]") {
    run::Scene<3> scene;
    scene.mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 0.5, 0.5}, {6, 3, 3}, mesh::CellShape::hexahedron, "block");
    scene.solid.materials = {{.young = 2.0, .poisson = 0.3, .density = 1.5}};
    scene.velocity = {Vector<3>(0.1, 0.0, 0.0)};
    scene.added_velocity = [](const Vector<3>& x) -> Vector<3> {
        return 0.05 * std::sin(7.0 * x.sum()) * Vector<3>::Ones();
    };
    scene.contact = false;
    check_pieces<3>(scene, 9, results("block"));
}
