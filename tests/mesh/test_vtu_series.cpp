#include "mesh/meshes.hpp"

#include <fstream>
#include <locale>
#include <regex>

#include "abut/mesh/io/write_vtu.hpp"
#include "mesh/vtk_arrays.hpp"

using namespace abut;
using namespace abut::mesh;
using Catch::Matchers::Contains;
using test::component, test::find_array, test::read_grid;

namespace {

struct Listed {
    double time;
    std::string file;
};
std::vector<Listed> list_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::regex entry("timestep=\"([^\"]*)\" part=\"0\" file=\"([^\"]*)\"");
    std::vector<Listed> result;
    for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i)
        result.push_back({std::stod((*i)[1]), (*i)[2]});
    return result;
}

std::size_t n_files(const std::filesystem::path& folder) {
    std::size_t n = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) n += file.is_regular_file();
    return n;
}

std::size_t n_half_written(const std::filesystem::path& folder) {
    std::size_t n = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
        n += file.path().filename().string().find(".part") != std::string::npos;
    return n;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a series that is read back holds the fields, padded to three dimensions", "[mesh][vtu]",
                       ((int Dim), Dim), 2, 3) {
    const test::ScratchFolder folder;
    const auto mesh = [] {
        if constexpr (Dim == 2)
            return test::small_box(CellShape::triangle);
        else
            return test::small_box_3d(CellShape::prism);
    }();
    const auto n = static_cast<std::size_t>(mesh.n_cells());
    std::vector<Vector<Dim>> u(n);
    std::vector<Matrix<Dim>> stress(n);
    std::vector<double> energy(n), pressure(mesh.boundary_faces.size());
    for (std::size_t c = 0; c < n; ++c) {
        u[c] = Vector<Dim>::Constant(1.0 + static_cast<double>(c));
        stress[c] = Matrix<Dim>::Constant(2.0) + Matrix<Dim>::Identity() * static_cast<double>(c);
        energy[c] = 0.5 * static_cast<double>(c);
    }
    std::iota(pressure.begin(), pressure.end(), 10.0);

    VtuSeries<Dim> series(folder / "out", "run", mesh);
    for (const double time : {0.0, 0.25, 1.0 / 3.0})
        series.write({.time = time,
                      .displacement = u,
                      .cell_fields = {{"energy [J]", energy}, {"stress [Pa]", stress}},
                      .boundary_fields = {{"contact pressure [Pa]", pressure}}});
    CHECK(series.n_frames() == 3);

    const auto listed = list_of(folder / "out/run.pvd");
    REQUIRE(listed.size() == 3);
    CHECK(listed[2].time == 1.0 / 3.0);
    CHECK(listed[2].file == "frames/run_000002.vtu");
    const auto surfaces = list_of(folder / "out/run_surface.pvd");
    REQUIRE(surfaces.size() == 3);
    CHECK(n_files(folder / "out") == 8);  // nothing half-written left behind

    const VtkGrid grid = read_grid(folder / ("out/" + listed[1].file));
    REQUIRE(grid.n_cells() == n);
    const VtkArray* displacement = find_array(grid.cell_data, "displacement");
    REQUIRE(displacement->n_components == 3);
    CHECK(component(displacement, 4, 0) == 5.0);
    CHECK(component(displacement, 4, 2) == (Dim == 3 ? 5.0 : 0.0));
    const VtkArray* tensor = find_array(grid.cell_data, "stress [Pa]");
    REQUIRE(tensor->n_components == 6);
    CHECK(component(tensor, 3, 0) == 5.0);
    CHECK(component(tensor, 3, 2) == (Dim == 3 ? 5.0 : 0.0));
    CHECK(component(tensor, 3, 3) == 2.0);
    CHECK(component(find_array(grid.cell_data, "energy [J]"), 6, 0) == 3.0);
    CHECK(component(find_array(grid.cell_data, "body"), 0, 0) == 0.0);

    const VtkGrid surface = read_grid(folder / ("out/" + surfaces[1].file));
    REQUIRE(surface.n_cells() == mesh.boundary_faces.size());
    CHECK(component(find_array(surface.cell_data, "contact pressure [Pa]"), 2, 0) == 12.0);
    REQUIRE(find_array(surface.point_data, "displacement") != nullptr);
    CHECK(surface.points.size() <= mesh.vertices.size());
}

TEST_CASE("a frame says its time, the numbers of bodies by name, and which boundary faces are in which group",
          "[mesh][vtu]") {
    const test::ScratchFolder folder;
    CellSoup<2> soup{.name = "two",
                     .vertices = {{0, 0}, {1, 0}, {0, 1}, {3, 0}, {4, 0}, {3, 1}},
                     .cell_shape = {CellShape::triangle, CellShape::triangle},
                     .cell_body = {0, 1},
                     .body_names = {"left", "a < b & \"c\""},
                     .named_faces = {{{0, 1}, 0}, {{4, 3}, 0}, {{1, 2}, 1}},
                     .group_names = {"bottom", "slope"}};
    soup.cell_vertices.append(std::vector<std::int32_t>{0, 1, 2});
    soup.cell_vertices.append(std::vector<std::int32_t>{3, 4, 5});
    const Mesh<2> mesh = build_mesh<2>(soup);
    VtuSeries<2> series(folder.path(), "run", mesh);
    series.write({.time = 0.1});
    for (const char* name : {"frames/run_000000.vtu", "frames/run_surface_000000.vtp"}) {
        std::ifstream file(folder / name, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        CHECK_THAT(text,
                   Contains("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.1<") &&
                       Contains("Name=\"body: left\" NumberOfTuples=\"1\" format=\"ascii\">0<") &&
                       Contains("Name=\"body: a &lt; b &amp; &quot;c&quot;\" NumberOfTuples=\"1\" format=\"ascii\">1<"));
    }
    const VtkGrid surface = read_grid(folder / "frames/run_surface_000000.vtp");
    REQUIRE(surface.n_cells() == 6);
    for (std::size_t face = 0; face < surface.n_cells(); ++face) {
        const auto corners = surface.corners_of(face);
        const Vector<3> middle = 0.5 * (surface.points[static_cast<std::size_t>(corners[0])] +
                                        surface.points[static_cast<std::size_t>(corners[1])]);
        CHECK(component(find_array(surface.cell_data, "group: bottom"), face, 0) == (middle[1] == 0.0 ? 1.0 : 0.0));
        CHECK(component(find_array(surface.cell_data, "group: slope"), face, 0) == (middle[0] == 0.5 && middle[1] == 0.5));
    }
}

TEST_CASE("a prism is written as VTK documents a wedge: its first triangle is counter-clockwise from outside",
          "[mesh][vtu]") {
    const test::ScratchFolder folder;
    const Mesh<3> mesh = test::small_box_3d(CellShape::prism);
    write_vtu(mesh, folder / "prisms.vtu");
    const VtkGrid grid = read_grid(folder / "prisms.vtu");
    const auto n_cells = static_cast<std::size_t>(mesh.n_cells());
    REQUIRE(grid.n_cells() == n_cells + mesh.boundary_faces.size());  // which are all in groups
    for (std::size_t cell = 0; cell < n_cells; ++cell) {
        std::vector<Vector<3>> x;
        for (const std::int64_t point : grid.corners_of(cell)) x.push_back(grid.points[static_cast<std::size_t>(point)]);
        CHECK((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) < 0.0);
    }
}

TEST_CASE("the displacement of a vertex is the mean of its own body's cells", "[mesh][vtu]") {
    const test::ScratchFolder folder;
    const std::vector<Mesh<2>> bodies = {fan_disc({0, 0}, 1, 6), fan_disc({2, 0}, 1, 6)};  // they touch at (1, 0)
    const auto mesh = combine<2>(bodies);
    std::vector<Vector<2>> u(12, Vector<2>(1, 0));
    for (std::size_t c = 6; c < 12; ++c) u[c] = {-3, 2};
    VtuSeries<2> series(folder.path(), "pair", mesh);
    series.write({.displacement = u});
    const VtkGrid grid = read_grid(folder / "frames/pair_000000.vtu");
    const VtkArray* displacement = find_array(grid.point_data, "displacement");
    for (std::size_t point = 0; point < grid.points.size(); ++point)
        CHECK(component(displacement, point, 0) == (point < 7 ? 1.0 : -3.0));
}

TEST_CASE("a displacement that is known at the vertices is written there as it is", "[mesh][vtu]") {
    const test::ScratchFolder folder;
    const auto mesh = test::small_box(CellShape::triangle);
    std::vector<Vector<2>> u;
    for (const Vector<2>& x : mesh.vertices) u.emplace_back(x[1], -x[0]);
    VtuSeries<2> series(folder.path(), "turned", mesh);
    series.write({.vertex_displacement = u});
    const VtkGrid grid = read_grid(folder / "frames/turned_000000.vtu");
    const VtkArray* displacement = find_array(grid.point_data, "displacement");
    CHECK(find_array(grid.cell_data, "displacement") == nullptr);
    for (std::size_t point = 0; point < grid.points.size(); ++point)
        for (const int d : {0, 1}) CHECK(component(displacement, point, static_cast<std::size_t>(d)) == u[point][d]);
    u.pop_back();
    CHECK_THROWS_WITH(series.write({.vertex_displacement = u}), Contains("vertices is needed"));
}

TEST_CASE("a field of the wrong size is refused by name and writes nothing", "[mesh][vtu]") {
    const test::ScratchFolder folder;
    const auto mesh = test::small_box(CellShape::quadrangle);
    VtuSeries<2> series(folder.path(), "run", mesh);
    const std::vector<double> values(5, 1.0);
    const std::vector<Vector<2>> u(5, Vector<2>::Zero());
    CHECK_THROWS_WITH(series.write({.cell_fields = {{"energy", values}}}),
                      "VtuSeries: field 'energy' has 5 values, one for each of the 12 cells is needed.");
    CHECK_THROWS_WITH(series.write({.boundary_fields = {{"gap", values}}}),
                      Contains("one for each of the 14 boundary faces is needed."));
    CHECK_THROWS_WITH(series.write({.displacement = u}), Contains("field 'displacement' has 5 values"));
    CHECK(n_files(folder.path()) == 0);
    CHECK(series.n_frames() == 0);
}

TEST_CASE("a folder that cannot be written is refused", "[mesh][vtu]") {
    const test::ScratchFolder folder;
    const auto mesh = test::small_box(CellShape::quadrangle);
    std::ofstream(folder / "file") << "in the way";
    CHECK_THROWS_WITH((VtuSeries<2>(folder / "file", "run", mesh)), Contains("file: the folder cannot be made"));
    CHECK_THROWS_AS((VtuSeries<2>(folder / "file/below", "run", mesh)), MeshError);
    CHECK_THROWS_WITH(write_vtu(mesh, folder / "missing/mesh.vtu"),
                      Contains("mesh.vtu: cannot be written: No such file or directory. Check permissions"));
    VtuSeries<2> series(folder / "gone", "run", mesh);
    series.write({});
    std::filesystem::remove_all(folder / "gone");
    CHECK_THROWS_AS(series.write({}), MeshError);
    CHECK(series.n_frames() == 1);
}

TEST_CASE("a frame that cannot be finished leaves the lists of the frames before it, and no half-written file",
          "[mesh][vtu]") {
    const test::ScratchFolder folder;
    const auto mesh = test::small_box(CellShape::quadrangle);
    VtuSeries<2> series(folder.path(), "run", mesh);
    series.write({.time = 1.0});
    // Folders in the way: of a frame's second file, of its first, of the second list, and of where either list is prepared.
    const std::string obstacle = GENERATE("frames/run_surface_000001.vtp", "frames/run_000001.vtu", "run_surface.pvd",
                                          ".run.part.pvd", ".run_surface.part.pvd", "frames/.run_surface_000001.part.vtp");
    CAPTURE(obstacle);
    const bool is_list = obstacle == "run_surface.pvd";
    if (is_list) std::filesystem::remove(folder / obstacle);
    std::filesystem::create_directories(folder / (obstacle + "/in_the_way"));
    CHECK_THROWS_AS(series.write({.time = 2.0}), MeshError);
    CHECK(series.n_frames() == 1);
    CHECK(list_of(folder / "run.pvd").size() == 1);
    if (!is_list) CHECK(list_of(folder / "run_surface.pvd").size() == 1);
    std::filesystem::remove_all(folder / obstacle);
    CHECK(n_half_written(folder.path()) == 0);
    series.write({.time = 2.0});
    CHECK(list_of(folder / "run.pvd").size() == 2);
    CHECK(list_of(folder / "run_surface.pvd").size() == 2);
    CHECK(n_files(folder.path()) == 6);
}

TEST_CASE("numbers in files and messages do not follow the locale of the program", "[mesh][vtu]") {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    struct GlobalLocale {
        std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
        ~GlobalLocale() { std::locale::global(before); }
    };
    const test::ScratchFolder folder;
    const auto mesh = test::small_box(CellShape::quadrangle);
    const GlobalLocale with_commas;
    VtuSeries<2> series(folder.path(), "run", mesh);
    series.write({.time = 1234567.25});
    series.write({.time = 1.0 / 3.0});
    CHECK_THROWS_WITH(disc({.radius = -1.5}), Contains("radius is -1.5 m"));
    CHECK(std::ssize(read_grid(folder / "frames/run_000001.vtu").cell_types) == mesh.n_cells());
    std::locale::global(std::locale::classic());
    const auto listed = list_of(folder / "run.pvd");
    REQUIRE(listed.size() == 2);
    CHECK(listed[0].time == 1234567.25);
    CHECK(listed[1].time == 1.0 / 3.0);
}
