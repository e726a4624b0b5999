#include <gmsh.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "abut/base/messages.hpp"
#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"
#include "mesh/vtk_arrays.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
using Catch::Matchers::Contains;

namespace {

/// A section of a file, with one array of text for each type, name, number of components and values.
struct TextArray {
    const char *type, *name;
    int n_components;
    std::string values;
};
std::string section(const std::string& name, const std::vector<TextArray>& arrays) {
    std::string text = "<" + name + ">";
    for (const TextArray& array : arrays)
        text += std::string("<DataArray type=\"") + array.type + "\" Name=\"" + array.name + "\" NumberOfComponents=\"" +
                std::to_string(array.n_components) + "\" format=\"ascii\">" + array.values + "</DataArray>\n";
    return text + "</" + name + ">\n";
}
std::string cells(const std::string& name, const std::string& corners, const std::string& ends,
                  const std::vector<TextArray>& more = {}) {
    std::vector<TextArray> arrays = {{"Int64", "connectivity", 1, corners}, {"Int64", "offsets", 1, ends}};
    arrays.insert(arrays.end(), more.begin(), more.end());
    return section(name, arrays);
}
std::string file_of(const std::string& type, const std::string& counts, const std::string& sections) {
    return "<VTKFile type=\"" + type + "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" + type + "><Piece " + counts +
           ">\n" + sections + "</Piece></" + type + "></VTKFile>\n";
}

const std::string seven_points = section("Points", {{"Float64", "Points", 3, "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0 5 5 5"}});

/// A triangle, a quadrangle and a strip of two triangles, and a vertex; the array "body" and a displacement.
std::string poly_data(int n_components = 3,
                      const std::string& displacement = "0 0 0 1 0 -1 2 0 -2 3 0 -3 4 0 -4 5 0 -5 6 0 -6") {
    return file_of("PolyData",
                   "NumberOfPoints=\"7\" NumberOfVerts=\"1\" NumberOfLines=\"0\" NumberOfStrips=\"1\" NumberOfPolys=\"2\"",
                   section("PointData", {{"Float64", "displacement", n_components, displacement}}) +
                       section("CellData", {{"Float64", "body", 1, "9 4 2 4"}}) + seven_points + cells("Verts", "6", "1") +
                       cells("Polys", "0 1 2 2 3 5 4", "3 7") + cells("Strips", "0 1 2 3", "4"));
}

/// Two squares of z = 0 and z = 1, each in a physical group, as a mesh of triangles only.
void save_squares_with_gmsh(const std::filesystem::path& path, bool with_groups) {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("squares");
    for (int i = 0; i < 2; ++i) {
        const int surface = gmsh::model::occ::addRectangle(0, 0, i, 1, 1);
        gmsh::model::occ::synchronize();
        if (with_groups)
            gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {surface}), i == 0 ? "lower" : "upper");
    }
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
    gmsh::model::mesh::generate(2);
    gmsh::write(path.string());
    gmsh::finalize();
}

}  // namespace

TEST_CASE("VTP gives polygons, strips, bodies and displacement", "[mesh][surface]") {
    const ScratchFolder folder;
    save(folder / "a.vtp", poly_data());
    const SurfaceMesh mesh = read_surface(folder / "a.vtp");
    CHECK(mesh.n_ignored_elements == 1);
    CHECK(mesh.faces.size() == 4);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2, 2, 3, 5, 4, 0, 1, 2, 1, 3, 2});
    CHECK(mesh.body_names == std::vector<std::string>{"body_2", "body_4"});
    CHECK(mesh.face_body == std::vector<std::int32_t>{1, 0, 1, 1});
    CHECK(mesh.face_label == std::vector<std::int64_t>{1, 2, 3, 3});
    REQUIRE(mesh.displacement.size() == 7);
    CHECK(mesh.displacement[5] == Vector<3>(5, 0, -5));
    CHECK(read_surface(folder / "a.vtp", {.displacement = ""}).displacement.empty());
    CHECK_THAT(complaint_about(folder / "a.vtp", {.displacement = "u"}),
               Contains("a.vtp: has no point array 'u'; there is 'displacement'. Correct the name"));
}

TEST_CASE("a displacement of other than three finite components is refused", "[mesh][surface]") {
    const ScratchFolder folder;
    save(folder / "a.vtp", poly_data(3, "0 0 0 1 0 -1 2 0 -2 3 0 -3 4 inf -4 5 0 -5 6 0 -6"));
    CHECK_THAT(complaint_about(folder / "a.vtp"), Contains("the displacement of vertex 4 is no finite vector."));
    save(folder / "b.vtp", poly_data(2, "0 0 0 0 0 0 0 0 0 0 0 0 0 0"));
    CHECK_THAT(complaint_about(folder / "b.vtp"), Contains("has 2 components, a displacement has 3."));
}

TEST_CASE("VTU gives its surface cells, or the boundary of its volume with the displacement", "[mesh][surface]") {
    const ScratchFolder folder;
    save(folder / "a.vtu",
         file_of("UnstructuredGrid", "NumberOfPoints=\"7\" NumberOfCells=\"4\"",
                 seven_points + cells("Cells", "0 1 0 1 2 3 0 1 3 5 4 0 1 2 3 4", "2 6 11 16",
                                      {{"UInt8", "types", 1, "3 8 7 6"}})));  // line, pixel, polygon, strip
    const SurfaceMesh mesh = read_surface(folder / "a.vtu");
    CHECK(mesh.n_ignored_elements == 1);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 3, 2, 0, 1, 3, 5, 4, 0, 1, 2, 1, 3, 2, 2, 3, 4});
    CHECK(mesh.body_names == std::vector<std::string>{"a"});

    // Cells and displacement through our own writer: u = 2 x at vertices, by cells of equal u.
    const Mesh<3> box = small_box_3d(CellShape::hexahedron);
    std::vector<Vector<3>> u(static_cast<std::size_t>(box.n_cells()), Vector<3>(1, 2, 3));
    VtuSeries<3> series(folder.path(), "run", box);
    series.write({.displacement = u});
    const SurfaceMesh boundary = read_surface(folder / "frames/run_000000.vtu");
    CHECK(boundary.faces.size() == 2 * (4 * 3 + 3 * 5 + 5 * 4));
    check_is_solid(boundary, 2.0 * 1.0 * 3.0, box.body_names[0]);
    CHECK(boundary.displacement == std::vector<Vector<3>>(boundary.vertices.size(), Vector<3>(1, 2, 3)));
}

TEST_CASE("the displacement of a volume goes to the vertices it belongs to", "[mesh][surface]") {
    const ScratchFolder folder;
    std::string points, twice;
    std::vector<Vector<3>> vertices;
    for (const Vector<3>& x : corners_of(CellShape::hexahedron)) vertices.push_back(x);
    vertices.push_back({9, 9, 9});  // used by no cell
    for (const Vector<3>& x : vertices)
        for (int d = 0; d < 3; ++d) {
            points += exact_number(x[d]) + " ";
            twice += exact_number(2 * x[d]) + " ";
        }
    save(folder / "a.vtu", file_of("UnstructuredGrid", "NumberOfPoints=\"9\" NumberOfCells=\"1\"",
                                   section("PointData", {{"Float64", "displacement", 3, twice}}) +
                                       section("Points", {{"Float64", "Points", 3, points}}) +
                                       cells("Cells", "0 1 2 3 4 5 6 7", "8", {{"UInt8", "types", 1, "12"}})));
    const SurfaceMesh mesh = read_surface(folder / "a.vtu");
    CHECK(mesh.vertices.size() == 8);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) CHECK(mesh.displacement[v] == 2.0 * mesh.vertices[v]);
}

TEST_CASE("MSH gives its triangles with their groups, or the boundary of its volume", "[mesh][surface]") {
    const ScratchFolder folder;
    save_squares_with_gmsh(folder / "squares.msh", true);
    const SurfaceMesh mesh = read_surface(folder / "squares.msh");
    CHECK(mesh.body_names == std::vector<std::string>{"lower", "upper"});
    const auto health = health_of(mesh);
    CHECK(health.n_usable() == mesh.faces.size());
    CHECK(health.components.size() == 2);
    CHECK(health.area == Approx(2.0));
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face)
        CHECK(mesh.vertices[static_cast<std::size_t>(mesh.faces[face][0])].z() ==
              mesh.face_body[static_cast<std::size_t>(face)]);
    save_squares_with_gmsh(folder / "plain.msh", false);
    CHECK(read_surface(folder / "plain.msh").body_names == std::vector<std::string>{"plain"});
    CHECK(read_surface(folder / "plain.msh", {.connected_bodies = true}).body_names ==
          std::vector<std::string>{"body_1", "body_2"});
}

TEST_CASE("faces written as VTP come back with their arrays", "[mesh][surface]") {
    const ScratchFolder folder;
    const SurfaceMesh gear = gear_surface({.n_teeth = 5});
    std::vector<double> pressure;
    std::vector<Vector<3>> force, u;
    for (std::int32_t face = 0; face < gear.faces.size(); ++face) {
        pressure.push_back(0.1 * face);
        force.push_back({1.0 / 3.0, -face / 7.0, 0.0});
    }
    for (const Vector<3>& x : gear.vertices) u.push_back(0.1 * x);
    const std::array<Field<3>, 2> of_faces = {Field<3>{"pressure [Pa]", std::span<const double>(pressure)},
                                              Field<3>{"force [N]", std::span<const Vector<3>>(force)}};
    const std::array<Field<3>, 1> of_vertices = {Field<3>{"displacement", std::span<const Vector<3>>(u)}};
    write_vtp(gear.soup(), folder / "gear.vtp", {of_faces, of_vertices});
    const VtkGrid grid = read_grid(folder / "gear.vtp");
    REQUIRE(std::ssize(grid.cell_types) == gear.faces.size());
    const VtkArray* scalars = find_array(grid.cell_data, "pressure [Pa]");
    const VtkArray* vectors = find_array(grid.cell_data, "force [N]");
    REQUIRE(scalars != nullptr);
    REQUIRE(vectors != nullptr);
    CHECK(same_bits(scalars->values, pressure));
    for (std::size_t face = 0; face < force.size(); ++face) CHECK(component(vectors, face, 1) == force[face].y());
    const SurfaceMesh again = read_surface(folder / "gear.vtp");
    CHECK(same_bits(again.vertices, gear.vertices));
    CHECK(again.faces.values == gear.faces.values);
    CHECK(same_bits(again.displacement, u));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);  // nothing half-written is left
}

TEST_CASE("what cannot be written as VTP is refused and leaves the file as it was", "[mesh][surface]") {
    const ScratchFolder folder;
    SurfaceMesh torus = torus_surface({});
    const std::vector<double> few(7, 0.0);
    const std::array<Field<3>, 1> fields = {Field<3>{"p", std::span<const double>(few)}};
    CHECK_THROWS_WITH(write_vtp(torus.soup(), folder / "a.vtp", {.of_faces = fields}),
                      "write_vtp: field 'p' has 7 values, one for each of the 1536 faces is needed.");
    CHECK_THROWS_AS(write_vtp(torus.soup(), folder / "none" / "a.vtp"), MeshError);
    torus.faces.values[5] = 4711;
    CHECK_THROWS_WITH(write_vtp(torus.soup(), folder / "a.vtp"),
                      "write_vtp: face 1 names vertex 4711, but there are 768. Leave it out.");
    CHECK_FALSE(std::filesystem::exists(folder / "a.vtp"));
}
