#include "mesh/meshes.hpp"

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

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"

using namespace abut;
using namespace abut::mesh;
using Catch::Matchers::Contains;

namespace {

const std::string cube_obj =
    "# a cube\no cube\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "vt 0 0\nvn 0 0 1\ng all\nusemtl none\ns off\nf 1/1/1 4/1/1 3/1/1 2/1/1\nf 5 6 7 8\nf 1//1 2//1 6//1 5//1\n"
    "f 2/1 3/1 7/1 6/1\nf -6 -5 -1 -2\nf 4 1 5 8\n";
const std::string cube_off =
    "OFF\n# a cube\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
    "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const std::string cube_ply =
    "ply\nformat ascii 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 6\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n"
    "0 1 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

void save(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string with_crlf(const std::string& text) {
    std::string result;
    for (const char letter : text) result += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
    return result;
}

template <class Value>
void append_bytes(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // on the machines at hand the smallest first
}

std::string binary_stl(const SurfaceMesh& mesh, const std::string& head = "made by a test") {
    std::string bytes = head;
    bytes.resize(80, ' ');
    append_bytes(bytes, static_cast<std::uint32_t>(mesh.faces.size()));
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        for (int i = 0; i < 3; ++i) append_bytes(bytes, 0.0f);
        for (const std::int32_t v : mesh.faces[face])
            for (const double x : mesh.vertices[static_cast<std::size_t>(v)]) append_bytes(bytes, static_cast<float>(x));
        append_bytes(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string ascii_stl(const SurfaceMesh& mesh) {
    std::ostringstream text;
    text << "solid made by a test\n";
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        text << "facet normal 0 0 0\nouter loop\n";
        for (const std::int32_t v : mesh.faces[face])
            text << "vertex " << static_cast<float>(mesh.vertices[static_cast<std::size_t>(v)].x()) << ' '
                 << static_cast<float>(mesh.vertices[static_cast<std::size_t>(v)].y()) << ' '
                 << static_cast<float>(mesh.vertices[static_cast<std::size_t>(v)].z()) << '\n';
        text << "endloop\nendfacet\n";
    }
    text << "endsolid made by a test\n";
    return text.str();
}

std::string complaint_about(const std::filesystem::path& path, const SurfaceOptions& options = {}) {
    try {
        (void)read_surface(path, options);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "nothing";
}

geometry::SurfaceReport health_of(const SurfaceMesh& mesh) { return geometry::check_surface(mesh.soup()); }

/// Watertight, with that volume, and one body called like the file.
void check_is_solid(const SurfaceMesh& mesh, double volume, const std::string& body) {
    const auto health = health_of(mesh);
    CHECK(health.sound());
    REQUIRE(health.components.size() == 1);
    CHECK(health.components[0].volume == Approx(volume).epsilon(1e-6));
    CHECK(mesh.body_names == std::vector<std::string>{body});
    CHECK(mesh.face_body == std::vector<std::int32_t>(static_cast<std::size_t>(mesh.faces.size()), 0));
}

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

TEST_CASE("a cube of quadrangles comes in whole from OBJ, OFF and PLY, whatever ends its lines", "[mesh][surface]") {
    const test::ScratchFolder folder;
    const bool crlf = GENERATE(false, true);
    for (const auto& [file, text] :
         {std::pair{"box.obj", cube_obj}, std::pair{"box.off", cube_off}, std::pair{"box.PLY", cube_ply}}) {
        CAPTURE(file, crlf);
        save(folder / file, crlf ? with_crlf(text) : text);
        const SurfaceMesh mesh = read_surface(folder / file);
        CHECK(mesh.vertices.size() == 8);
        CHECK(mesh.faces.size() == 6);
        CHECK(mesh.faces[0].size() == 4);
        CHECK(mesh.name == (folder / file).string());
        check_is_solid(mesh, 1.0, "box");
    }
}

TEST_CASE("binary PLY comes in, in both orders of bytes", "[mesh][surface]") {
    const test::ScratchFolder folder;
    for (const bool little : {true, false}) {
        std::string bytes = std::string("ply\nformat binary_") + (little ? "little" : "big") +
                            "_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        const auto append = [&](auto value) {
            std::string piece;
            append_bytes(piece, value);
            if (!little) std::reverse(piece.begin(), piece.end());
            bytes += piece;
        };
        for (const double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.1, std::nan("")}) append(x);
        append(std::uint8_t{3});
        for (const std::int32_t v : {0, 1, 7}) append(v);
        save(folder / "a.ply", bytes);
        const SurfaceMesh mesh = read_surface(folder / "a.ply");
        CHECK(mesh.vertices[2].y() == 0.1);
        CHECK(std::isnan(mesh.vertices[2].z()));  // kept, for the health report to judge
        CHECK(health_of(mesh).faults[0] == geometry::FaceFault::index_out_of_range);
    }
}

TEST_CASE("polygons of any number of corners, lines and points: faces are kept, the rest is counted", "[mesh][surface]") {
    const test::ScratchFolder folder;
    save(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2\nl 1 2 3\np 4\nf 1 3 4\n");
    const SurfaceMesh mesh = read_surface(folder / "a.obj");
    CHECK(mesh.n_ignored_elements == 2);
    REQUIRE(mesh.faces.size() == 3);
    CHECK(mesh.faces[0].size() == 5);
    CHECK(health_of(mesh).faults[1] == geometry::FaceFault::too_few_corners);
}

TEST_CASE("STL comes in welded, from ASCII and binary, even if that begins with 'solid'", "[mesh][surface]") {
    const test::ScratchFolder folder;
    const SurfaceMesh ball = sphere_surface({.n_subdivisions = 2});
    const double volume = health_of(ball).components[0].volume;
    for (const std::string& contents :
         {ascii_stl(ball), with_crlf(ascii_stl(ball)), binary_stl(ball), binary_stl(ball, "solid in name only")}) {
        save(folder / "ball.stl", contents);
        const SurfaceMesh mesh = read_surface(folder / "ball.stl");
        CHECK(mesh.vertices.size() == ball.vertices.size());
        check_is_solid(mesh, volume, "ball");
    }
    save(folder / "ball.stl", binary_stl(ball));
    const SurfaceMesh apart = read_surface(folder / "ball.stl", {.weld = false});
    CHECK(apart.vertices.size() == static_cast<std::size_t>(3 * ball.faces.size()));
    check_is_solid(apart, volume, "ball");
}

TEST_CASE("a binary STL file keeps corners that are no numbers apart", "[mesh][surface]") {
    const test::ScratchFolder folder;
    SurfaceMesh bad = sphere_surface({.n_subdivisions = 0});
    bad.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
    save(folder / "bad.stl", binary_stl(bad));
    const auto health = health_of(read_surface(folder / "bad.stl"));
    CHECK(health.n_faults[static_cast<std::size_t>(geometry::FaceFault::not_finite)] == 5);  // around a corner
    CHECK(health.n_usable() == 15);
    CHECK(health.n_bad_vertices == 5);
}

TEST_CASE("a truncated surface file is refused, in any format", "[mesh][surface]") {
    const test::ScratchFolder folder;
    const SurfaceMesh ball = sphere_surface({.n_subdivisions = 1});
    const double part = GENERATE(0.1, 0.5, 0.9);
    const auto cut = [part](const std::string& whole) {
        return whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size())));
    };
    save(folder / "a.off", cut(cube_off));
    CHECK_THAT(complaint_about(folder / "a.off"), Contains("a.off: cannot be read as .off: behind ") &&
                                                      Contains("ends early") && Contains("write the mesh again."));
    save(folder / "a.ply", cut(cube_ply));
    CHECK_THAT(complaint_about(folder / "a.ply"), Contains("a.ply: "));
    save(folder / "a.stl", cut(ascii_stl(ball)));
    CHECK_THAT(complaint_about(folder / "a.stl"), Contains("a.stl: cannot be read as .stl: behind "));
    save(folder / "b.stl", cut(binary_stl(ball)));
    CHECK_THAT(complaint_about(folder / "b.stl"),
               Contains("b.stl: the file is truncated: 80 triangles need 4084 bytes, it has "));
    write_vtp(ball.soup(), folder / "whole.vtp");
    std::ifstream whole(folder / "whole.vtp", std::ios::binary);
    save(folder / "a.vtp", cut({std::istreambuf_iterator<char>(whole), {}}));
    CHECK_THAT(complaint_about(folder / "a.vtp"), Contains("a.vtp: the file is truncated: '</VTKFile>' is missing after "));
}

TEST_CASE("files that are missing, empty, garbage or of no known kind are refused", "[mesh][surface]") {
    const test::ScratchFolder folder;
    for (const std::string extension : {".obj", ".off", ".ply", ".stl", ".vtp", ".vtu", ".msh"}) {
        CAPTURE(extension);
        CHECK_THAT(complaint_about(folder / ("none" + extension)), Contains("there is no such file. Check the path."));
        save(folder / ("empty" + extension), "");
        CHECK_THAT(complaint_about(folder / ("empty" + extension)), Contains("the file is empty (0 bytes)."));
        std::string garbage;
        for (int i = 0; i < 400; ++i) garbage += static_cast<char>(i * 37 % 256);
        save(folder / ("garbage" + extension), garbage);
        CHECK_THAT(complaint_about(folder / ("garbage" + extension)), Contains("garbage" + extension + ": "));
    }
    CHECK_THAT(complaint_about(folder / "a.step"), Contains("a.step: the extension '.step' is none of a surface file"));
    CHECK_THAT(complaint_about(folder.path()), !Contains("nothing"));
}

TEST_CASE("text that promises more than it holds, or means no numbers, is refused", "[mesh][surface]") {
    const test::ScratchFolder folder;
    save(folder / "a.off", "OFF\n2000000000 2000000000 0\n0 0 0\n");
    CHECK_THAT(complaint_about(folder / "a.off"),
               Contains("a.off: the file is damaged: it promises 2000000000 vertices and 2000000000 faces in 34 bytes."));
    save(folder / "a.obj", "v 0 0 zero\nf 1 1 1\n");
    CHECK_THAT(complaint_about(folder / "a.obj"), Contains("holds a word where a number should be"));
    save(folder / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    CHECK_THAT(complaint_about(folder / "b.obj"), Contains("names a vertex that is not there"));
    save(folder / "c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    CHECK_THAT(complaint_about(folder / "c.obj"), Contains("c.obj: "));
    save(folder / "d.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
    CHECK_THAT(complaint_about(folder / "d.ply"), Contains("the surface is empty: the file has 0 faces"));
}

TEST_CASE("VTP gives polygons, strips, bodies and displacement", "[mesh][surface]") {
    const test::ScratchFolder folder;
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
    const test::ScratchFolder folder;
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
    const test::ScratchFolder folder;
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
    const Mesh<3> box = test::small_box_3d(CellShape::hexahedron);
    std::vector<Vector<3>> u(static_cast<std::size_t>(box.n_cells()), Vector<3>(1, 2, 3));
    VtuSeries<3> series(folder.path(), "run", box);
    series.write({.displacement = u});
    const SurfaceMesh boundary = read_surface(folder / "run_000000.vtu");
    CHECK(boundary.faces.size() == 2 * (4 * 3 + 3 * 5 + 5 * 4));
    check_is_solid(boundary, 2.0 * 1.0 * 3.0, "body_0");
    CHECK(boundary.displacement == std::vector<Vector<3>>(boundary.vertices.size(), Vector<3>(1, 2, 3)));
}

TEST_CASE("the displacement of a volume goes to the vertices it belongs to", "[mesh][surface]") {
    const test::ScratchFolder folder;
    vtkNew<vtkPoints> points;
    for (const Vector<3>& x : test::corners_of(CellShape::hexahedron)) points->InsertNextPoint(x.data());
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
    const test::ScratchFolder folder;
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

TEST_CASE("connected parts become bodies, welded or not", "[mesh][surface]") {
    std::vector<SurfaceMesh> tori = {torus_surface({.axis = 2}), torus_surface({.centre = {1, 0, 0}, .axis = 1})};
    SurfaceMesh both = combine(tori);
    CHECK(both.body_names == std::vector<std::string>{"torus.torus", "torus.torus_2"});
    CHECK(geometry::check_surface(both.soup(), {.self_intersections = true}).sound());  // interlocked, apart
    name_connected_bodies(both);
    CHECK(both.body_names == std::vector<std::string>{"body_1", "body_2"});
    CHECK(std::count(both.face_body.begin(), both.face_body.end(), 1) == tori[1].faces.size());

    const test::ScratchFolder folder;
    save(folder / "tori.stl", binary_stl(both));
    const SurfaceMesh apart = read_surface(folder / "tori.stl", {.weld = false, .connected_bodies = true});
    CHECK(apart.body_names.size() == 2);
    CHECK(apart.face_body == both.face_body);
}

TEST_CASE("welding keeps vertices apart that move apart", "[mesh][surface]") {
    SurfaceMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    mesh.faces.append(std::array{0, 1, 2});
    mesh.faces.append(std::array{3, 5, 4});
    mesh.faces.append(std::array{3, 5, 77});
    mesh.face_body = {0, 0, 0};
    mesh.body_names = {"a"};
    SurfaceMesh moving = mesh;
    CHECK(weld(mesh) == 2);
    CHECK(mesh.vertices.size() == 4);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2, 1, 3, 2, 1, 3, -1});
    moving.displacement.assign(6, Vector<3>::Zero());
    moving.displacement[4] = {0, 0, 1};
    CHECK(weld(moving) == 1);
    CHECK(moving.faces.values == std::vector<std::int32_t>{0, 1, 2, 1, 4, 3, 1, 4, -1});
    CHECK(moving.displacement[3] == Vector<3>(0, 0, 1));
}

TEST_CASE("cleaning under `fail` names the first faces, their faults and the remedy", "[mesh][surface]") {
    SurfaceMesh mesh = torus_surface({});
    CHECK(clean(mesh, health_of(mesh), UnusableFaces::fail).mesh.faces.values == mesh.faces.values);
    for (int i = 0; i < 6; ++i) {
        mesh.faces.append(std::array{0, 1, 9999});
        mesh.face_body.push_back(0);
    }
    const auto health = health_of(mesh);
    CHECK_THROWS_WITH(clean(mesh, health, UnusableFaces::fail),
                      Contains("torus: 6 of 1542 faces cannot be used: face 1536 names vertex 9999, but there are 768; face "
                               "1537 names") &&
                          Contains("; and 1 more. Mend the surface, or have such faces left out: UnusableFaces::skip."));
    const CleanSurface rest = clean(mesh, health, UnusableFaces::skip);
    CHECK(rest.n_skipped_faces == 6);
    CHECK(health_of(rest.mesh).sound());
    CHECK_THROWS_AS(clean(torus_surface({.n_tube = 8}), health, UnusableFaces::skip), BadInput);
}

TEST_CASE("cleaning cuts what is not flat and says where each face came from", "[mesh][surface]") {
    SurfaceMesh mesh;
    mesh.name = "bent";
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 0}};
    mesh.faces.append(std::array{0, 0, 0});     // no face
    mesh.faces.append(std::array{0, 1, 2, 3});  // not flat
    mesh.faces.append(std::array{1, 4, 5});     // fine
    mesh.faces.append(std::array{1, 6, 5, 2});  // a corner twice
    mesh.face_body = {0, 1, 2, 1};
    mesh.body_names = {"a", "b", "c"};
    mesh.face_label = {10, 11, 12, 13};
    const CleanSurface result = clean(mesh, health_of(mesh), UnusableFaces::skip);
    CHECK(result.n_skipped_faces == 1);
    CHECK(result.n_cut_faces == 1);
    CHECK(result.n_flat_pieces == 0);
    CHECK(result.input_face == std::vector<std::int32_t>{1, 1, 2, 3});
    CHECK(result.mesh.face_body == std::vector<std::int32_t>{1, 1, 2, 1});
    CHECK(result.mesh.face_label == std::vector<std::int64_t>{11, 11, 12, 13});
    CHECK(result.mesh.faces[3].size() == 3);
    const auto health = health_of(result.mesh);
    CHECK(health.n_usable() == 4);
    CHECK(health.non_planar_faces.empty());
    CHECK(health.repeated_corner_faces.empty());
    mesh.faces = {};
    mesh.faces.append(std::array{0, 0, 0});
    CHECK_THROWS_WITH(clean(mesh, health_of(mesh), UnusableFaces::skip), Contains("bent: 1 of 1 faces cannot be used"));
}

TEST_CASE("faces written as VTP come back through VTK with their arrays", "[mesh][surface]") {
    const test::ScratchFolder folder;
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
    CHECK(test::same_bits(again.vertices, gear.vertices));
    CHECK(again.faces.values == gear.faces.values);
    CHECK(test::same_bits(again.displacement, u));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);  // nothing half-written is left
}

TEST_CASE("what cannot be written as VTP is refused and leaves the file as it was", "[mesh][surface]") {
    const test::ScratchFolder folder;
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
