#include <gmsh.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <limits>
#include <span>

#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
using Catch::Matchers::Contains;

namespace {

/// Two triangles and a quadrangle of a cell each, and a strip of two triangles; the array "body" and a displacement.
vtkSmartPointer<vtkPolyData> poly_data() {
    vtkNew<vtkPoints> points;
    for (const Vector<3>& x : {Vector<3>(0, 0, 0), Vector<3>(1, 0, 0), Vector<3>(0, 1, 0), Vector<3>(1, 1, 0),
                               Vector<3>(0, 2, 0), Vector<3>(1, 2, 0), Vector<3>(5, 5, 5)})
        points->InsertNextPoint(x.data());
    auto grid = vtkSmartPointer<vtkPolyData>::New();
    grid->SetPoints(points);
    vtkNew<vtkCellArray> vertices, polygons, strips;
    vertices->InsertNextCell({6});
    polygons->InsertNextCell({0, 1, 2});
    polygons->InsertNextCell({2, 3, 5, 4});
    strips->InsertNextCell({0, 1, 2, 3});
    grid->SetVerts(vertices);
    grid->SetPolys(polygons);
    grid->SetStrips(strips);
    vtkNew<vtkDoubleArray> bodies, displacement;
    bodies->SetName("body");
    for (const double body : {9.0, 4.0, 2.0, 4.0}) bodies->InsertNextValue(body);
    grid->GetCellData()->AddArray(bodies);
    displacement->SetName("displacement");
    displacement->SetNumberOfComponents(3);
    for (int i = 0; i < 7; ++i) displacement->InsertNextTuple3(i, 0, -i);
    grid->GetPointData()->AddArray(displacement);
    return grid;
}

template <class Writer>
void save_grid(vtkDataObject& grid, const std::filesystem::path& path) {
    vtkNew<Writer> writer;
    writer->SetInputData(&grid);
    writer->SetFileName(path.c_str());
    REQUIRE(writer->Write() == 1);
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
    save_grid<vtkXMLPolyDataWriter>(*poly_data(), folder / "a.vtp");
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
    const auto grid = poly_data();
    grid->GetPointData()->GetArray("displacement")->SetComponent(4, 1, std::numeric_limits<double>::infinity());
    save_grid<vtkXMLPolyDataWriter>(*grid, folder / "a.vtp");
    CHECK_THAT(complaint_about(folder / "a.vtp"), Contains("the displacement of vertex 4 is no finite vector."));
    vtkNew<vtkDoubleArray> plane;
    plane->SetName("displacement");
    plane->SetNumberOfComponents(2);
    plane->SetNumberOfTuples(7);
    plane->Fill(0.0);
    grid->GetPointData()->AddArray(plane);
    save_grid<vtkXMLPolyDataWriter>(*grid, folder / "b.vtp");
    CHECK_THAT(complaint_about(folder / "b.vtp"), Contains("has 2 components, a displacement has 3."));
}

TEST_CASE("VTU gives its surface cells, or the boundary of its volume with the displacement", "[mesh][surface]") {
    const ScratchFolder folder;
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(poly_data()->GetPoints());
    const auto insert = [&](int type, std::vector<vtkIdType> ids) {
        grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    };
    insert(VTK_LINE, {0, 1});
    insert(VTK_PIXEL, {0, 1, 2, 3});
    insert(VTK_POLYGON, {0, 1, 3, 5, 4});
    insert(VTK_TRIANGLE_STRIP, {0, 1, 2, 3, 4});
    save_grid<vtkXMLUnstructuredGridWriter>(*grid, folder / "a.vtu");
    const SurfaceMesh mesh = read_surface(folder / "a.vtu");
    CHECK(mesh.n_ignored_elements == 1);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 3, 2, 0, 1, 3, 5, 4, 0, 1, 2, 1, 3, 2, 2, 3, 4});
    CHECK(mesh.body_names == std::vector<std::string>{"a"});

    // Cells and displacement through our own writer: u = 2 x at vertices, by cells of equal u.
    const Mesh<3> box = small_box_3d(CellShape::hexahedron);
    std::vector<Vector<3>> u(static_cast<std::size_t>(box.n_cells()), Vector<3>(1, 2, 3));
    VtuSeries<3> series(folder.path(), "run", box);
    series.write({.displacement = u});
    const SurfaceMesh boundary = read_surface(folder / "run_000000.vtu");
    CHECK(boundary.faces.size() == 2 * (4 * 3 + 3 * 5 + 5 * 4));
    check_is_solid(boundary, 2.0 * 1.0 * 3.0, "body_0");
    CHECK(boundary.displacement == std::vector<Vector<3>>(boundary.vertices.size(), Vector<3>(1, 2, 3)));
}

TEST_CASE("the displacement of a volume goes to the vertices it belongs to", "[mesh][surface]") {
    const ScratchFolder folder;
    vtkNew<vtkPoints> points;
    for (const Vector<3>& x : corners_of(CellShape::hexahedron)) points->InsertNextPoint(x.data());
    points->InsertNextPoint(9, 9, 9);  // used by no cell
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    std::array<vtkIdType, 8> ids = {0, 1, 2, 3, 4, 5, 6, 7};
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
    vtkNew<vtkDoubleArray> twice;
    twice->SetName("displacement");
    twice->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < 9; ++i) {
        const double* x = points->GetPoint(i);
        twice->InsertNextTuple3(2 * x[0], 2 * x[1], 2 * x[2]);
    }
    grid->GetPointData()->AddArray(twice);
    save_grid<vtkXMLUnstructuredGridWriter>(*grid, folder / "a.vtu");
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

TEST_CASE("faces written as VTP come back through VTK with their arrays", "[mesh][surface]") {
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
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder / "gear.vtp").c_str());
    reader->Update();
    vtkPolyData& grid = *reader->GetOutput();
    REQUIRE(grid.GetNumberOfPolys() == gear.faces.size());
    vtkDataArray* scalars = grid.GetCellData()->GetArray("pressure [Pa]");
    vtkDataArray* vectors = grid.GetCellData()->GetArray("force [N]");
    REQUIRE(scalars != nullptr);
    REQUIRE(vectors != nullptr);
    for (std::int32_t face = 0; face < gear.faces.size(); ++face) {
        CHECK(scalars->GetComponent(face, 0) == pressure[static_cast<std::size_t>(face)]);
        CHECK(vectors->GetComponent(face, 1) == force[static_cast<std::size_t>(face)].y());
    }
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
