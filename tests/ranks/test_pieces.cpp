// Frames that each rank writes its own cells of.

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "abut/run/files/frames.hpp"
#include "mesh/vtk_arrays.hpp"
#include "ranks/scenes.hpp"
#include "ranks/shared_run.hpp"

using namespace abut;

namespace {

namespace fs = std::filesystem;

/// All that a file shows of a cell: its arrays, then the positions and arrays of its corners.
using Cell = std::map<std::string, std::vector<double>>;

/// Adds the cells of a file by the number in array `number`; without it by their order.
void add_cells(std::map<int, Cell>& cells, const fs::path& path, const char* number) {
    const mesh::VtkGrid grid = mesh::test::read_grid(path);
    const auto append = [](std::vector<double>& values, const mesh::VtkArray& array, std::size_t tuple) {
        for (std::size_t k = 0; k < array.n_components; ++k) values.push_back(mesh::test::component(&array, tuple, k));
    };
    const mesh::VtkArray* numbers = mesh::test::find_array(grid.cell_data, number);
    const mesh::VtkArray* displacement = mesh::test::find_array(grid.point_data, "displacement");
    for (std::size_t c = 0; c < grid.n_cells(); ++c) {
        Cell& cell = cells[static_cast<int>(numbers ? mesh::test::component(numbers, c, 0) : static_cast<double>(c))];
        for (const mesh::VtkArray& array : grid.cell_data)
            if (array.name != number) append(cell[array.name], array, c);
        for (const std::int64_t corner : grid.corners_of(c)) {
            const auto point = static_cast<std::size_t>(corner);
            for (int j = 0; j < 3; ++j) cell["corners"].push_back(grid.points[point][j]);
            append(cell["displacement of corners"], *displacement, point);
        }
    }
}

/// Of a file, or of all pieces that it names.
std::map<int, Cell> cells_of(const fs::path& path, const char* number) {
    std::map<int, Cell> cells;
    if (!path.extension().string().starts_with(".p")) {
        add_cells(cells, path, number);
        return cells;
    }
    pugi::xml_document head;
    REQUIRE(head.load_file(path.c_str()));
    for (const auto& piece : head.select_nodes("//Piece"))
        add_cells(cells, path.parent_path() / piece.node().attribute("Source").value(), number);
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
    run::Frames<Dim> of_first(folder / "pieces", "bodies", 4, run::FrameFormat::vtu, true);
    run::PieceFiles<Dim> of_others(folder / "pieces", "bodies", scene.outputs.fields);
    run::Observer<Dim>& mine = all.rank() == 0 ? static_cast<run::Observer<Dim>&>(of_first) : of_others;
    static_cast<void>(run::simulate<Dim>(scene, options, mine, nullptr, mesh.share()));
    bool good = true;
    if (all.rank() == 0) {
        run::Frames<Dim> whole(folder / "whole", "bodies", 4);
        static_cast<void>(run::simulate<Dim>(scene, options, whole));
        for (int frame = 0; frame < 4; ++frame) {
            const std::string name = "frames/bodies_00000" + std::to_string(frame);
            CAPTURE(name);
            good = good && fs::exists(folder / "pieces" / (name + "_" + std::to_string(all.size() - 1) + ".vtu"));
            good = good && same(cells_of(folder / "whole" / (name + ".vtu"), "cell"),
                                cells_of(folder / "pieces" / (name + ".pvtu"), "cell"));
            const std::string surface = "frames/bodies_surface_00000" + std::to_string(frame);
            good = good && same(cells_of(folder / "whole" / (surface + ".vtp"), "face"),
                                cells_of(folder / "pieces" / (surface + ".pvtp"), "face"));
            CHECK(good);
        }
        CHECK(text_of(folder / "pieces" / "bodies.pvd").find("frames/bodies_000003.pvtu") != std::string::npos);
        CHECK(text_of(folder / "pieces" / "bodies_surface.pvd").find("frames/bodies_surface_000003.pvtp") !=
              std::string::npos);
        CHECK(fs::exists(folder / "pieces" / "frames/bodies_pairs_000003.vtp") ==
              (scene.contact && scene.outputs.fields.pairs));
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
