// OBJ, OFF, PLY and STL: what is legal comes in whole, what is not is refused with the line and the word, and nothing is made
// room for that the file does not hold.
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
using Catch::Matchers::Contains;

namespace {

const std::string square_of_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string refusal_of(const std::string& file, const std::string& text) {
    const ScratchFolder folder;
    save(folder / file, text);
    return complaint_about(folder / file);
}

SurfaceMesh read_text(const std::string& file, const std::string& text) {
    const ScratchFolder folder;
    save(folder / file, text);
    return read_surface(folder / file);
}

/// A header with three vertices of floats, and the rest of it.
std::string ply(const std::string& format, const std::string& rest) {
    return "ply\nformat " + format + " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + rest;
}

}  // namespace

TEST_CASE("an OBJ line that goes on behind a backslash is one line", "[mesh][surface][broken]") {
    for (const std::string end : {"\n", "\r\n"}) {
        const SurfaceMesh mesh =
            read_text("a.obj", square_of_obj + "f 1 2 3 \\" + end + "4\nv 2 \\" + end + "2 2\n# no more \\\nf 1 2 5\n");
        CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2, 3, 0, 1, 4});
        CHECK(mesh.faces.size() == 2);
        CHECK(mesh.vertices[4] == Vector<3>(2, 2, 2));
    }
    CHECK_THAT(refusal_of("a.obj", square_of_obj + "f 1 2 3 \\\n4x\n"),
               Contains("a.obj: line 6: '4x' is no corner of a face"));
}

TEST_CASE("a byte order mark at the start of an OBJ, OFF or STL file takes no vertex away", "[mesh][surface][broken]") {
    const SurfaceMesh mesh = read_text("a.obj", "\xEF\xBB\xBF" + square_of_obj + "v 9 9 9\nf 1 2 3 4\n");
    CHECK(mesh.vertices.size() == 5);
    CHECK(mesh.vertices[0] == Vector<3>(0, 0, 0));
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2, 3});
    CHECK(read_text("a.off", "\xEF\xBB\xBFOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").faces.size() == 1);
    CHECK(read_text("a.stl",
                    "\xEF\xBB\xBFsolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                    "endloop\nendfacet\nendsolid a\n")
              .faces.size() == 1);
}

TEST_CASE("an OBJ corner that is no index of a vertex is refused with its line and word", "[mesh][surface][broken]") {
    for (const std::string corner :
         {"x", "3.7", "0", "3x", "0x3", "1e0", "3/a", "/1", "--1", "\\", "99999999999999999999"}) {
        CAPTURE(corner);
        const std::string said = refusal_of("a.obj", square_of_obj + "f 1 2 3 4\nf 1 2 3 " + corner + " 4\n");
        CHECK_THAT(said, Contains("a.obj: line 6: '" + corner + "' is no corner of a face: its vertex, counted from 1"));
        CHECK_THAT(said, Contains("Correct the line, or write the mesh again."));
    }
    CHECK_THAT(refusal_of("a.obj", square_of_obj + "f 1 2 3 2147483648\n"),
               Contains("a.obj: line 5: the face names vertex 2147483648, the file has 4."));
    CHECK_THAT(refusal_of("a.obj", square_of_obj + "f 1 2 -5\n"),
               Contains("a.obj: line 5: the face names vertex -5, before it the file has 4."));
    CHECK(read_text("a.obj", "vt 0 0\nvn 0 0 1\n" + square_of_obj + "f 1//1 2//1 3//1\nf 1/1 2/1 -1/1\n").faces.values ==
          std::vector<std::int32_t>{0, 1, 2, 0, 1, 3});
}

TEST_CASE("a vertex before it may be named from the end only where there is one", "[mesh][surface][broken]") {
    CHECK_THAT(refusal_of("a.obj", "f -1 -1 -1\n" + square_of_obj),
               Contains("a.obj: line 1: the face names vertex -1, before it the file has 0."));
}

TEST_CASE("an OBJ coordinate with garbage behind it, missing or without end is refused", "[mesh][surface][broken]") {
    for (const std::string word : {"0x", "1,5", "1e", "--1", "+-1", "1e999", "0x10"})
        CHECK_THAT(refusal_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 " + word + "\nv 1 1 0\nf 1 2 3\n"),
                   Contains("a.obj: line 3: '" + word + "' is no number of a double, a coordinate is needed."));
    CHECK_THAT(refusal_of("a.obj", "v 0 0\nv 1 0 0\n"), Contains("a.obj: line 1: a coordinate is missing."));
    CHECK_THAT(refusal_of("a.obj", "v 0 0 inf\n"), Contains("a.obj: line 1: a coordinate is no finite number."));
    CHECK_THAT(refusal_of("a.obj", "v 0 0 0 red\n"),
               Contains("a.obj: line 1: 'red' is no number of a double, a weight or a colour"));
    const SurfaceMesh mesh =
        read_text("a.obj", "v +1 1e-400 -.5e1 0.1 0.2 0.3\nv 0 0 1e-310 1\nv 1. 0 0 # a comment\nf 1 2 3#\n");
    CHECK(mesh.vertices[0] == Vector<3>(1, 0, -5));
    CHECK(mesh.vertices[1] == Vector<3>(0, 0, 1e-310));
}

TEST_CASE("OBJ statements that nobody knows are skipped with a warning", "[mesh][surface][broken]") {
    const SurfaceMesh mesh = read_text("a.obj", square_of_obj + "g one\nff 1 2 3\nf 1 2 3\nsurf 0 1 0 1 1 2 3 4\n1 2 3\n");
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0] == "line 6 begins with no statement of an OBJ file; lines of that kind that were skipped: 2");
    CHECK(mesh.n_ignored_elements == 1);
}

TEST_CASE("an OFF face that promises more corners than its line has is refused", "[mesh][surface][broken]") {
    const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    CHECK_THAT(refusal_of("a.off", head + "1000 0 1 2\n"),
               Contains("a.off: line 6: face 0 has 1000 corners, its line names 3. Correct the line"));
    CHECK_THAT(refusal_of("a.off", head + "-3 0 1 2\n"),
               Contains("line 6: the number of corners of a face is -3, at least 0 is needed"));
    CHECK_THAT(refusal_of("a.off", head + "3 0 1 3\n"),
               Contains("line 6: face 0 names vertex 3, the file has 3, counted from 0."));
    CHECK_THAT(refusal_of("a.off", head + "3 0 1 2.5\n"),
               Contains("line 6: '2.5' is no whole number of 64 bits, a vertex is needed."));
    CHECK_THAT(refusal_of("a.off", head), Contains("line 5: the file is truncated: it ends before face 0 of 1."));
    CHECK_THAT(refusal_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n"), Contains("a.off: line 4: a coordinate is missing."));
    CHECK_THAT(refusal_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n"),
               Contains("line 4: a coordinate of vertex 1 is no finite number."));
    CHECK_THAT(refusal_of("a.off", "OFF BINARY\n3 1 0\n"),
               Contains("a.off: line 1: binary OFF is not read. Save the mesh as text OFF"));
    CHECK_THAT(refusal_of("a.off", "nOFF\n2\n3 1 0\n"), Contains("a.off: line 1: the file does not begin with OFF, COFF"));
}

TEST_CASE("OFF comes in with colours, normals, weights and comments", "[mesh][surface][broken]") {
    const SurfaceMesh mesh = read_text(
        "a.off", "# made by hand\nCOFF # colours\n3 1\n\n0 0 0 1 0 0 1\n1 0 0 255 0 0\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n");
    CHECK(mesh.vertices.size() == 3);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2});
    CHECK(read_text("a.off", "4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n0 1 0 1\n3 0 1 2\n").vertices[1] == Vector<3>(1, 0, 0));
    CHECK(read_text("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n").warnings ==
          std::vector<std::string>{"line 7: what follows 1 face, as many as the head promises, is not read"});
}

TEST_CASE("a PLY header that makes no sense is refused with its line", "[mesh][surface][broken]") {
    const std::string vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const auto said = [](const std::string& header) {
        return refusal_of("a.ply", "ply\nformat ascii 1.0\n" + header + "end_header\n0 0 0\n");
    };
    CHECK_THAT(
        said("property float x\n" + vertex),
        Contains("a.ply: line 3: 'property' stands before any 'element'. Put it behind the element that has the property."));
    CHECK_THAT(said("element vertex many\n"), Contains("a.ply: line 3: 'many' is no whole number of 64 bits"));
    CHECK_THAT(said("element vertex -1\n"), Contains("a.ply: line 3: there are -1 of the element 'vertex'"));
    CHECK_THAT(said("element vertex 3\nproperty real x\n"),
               Contains("a.ply: line 4: the type 'real' is none of char, uchar"));
    CHECK_THAT(said("element vertex 3\nproperty float\n"), Contains("a.ply: line 4: the property has no name"));
    CHECK_THAT(said("element vertex 1\nproperty float x\nproperty float y\n"),
               Contains("a.ply: line 3: the element 'vertex' has no property 'z'"));
    CHECK_THAT(said("vertices 3\n"), Contains("a.ply: line 3: 'vertices' is no word of a PLY header"));
    CHECK_THAT(said("element face 1\nproperty list float int vertex_indices\n"),
               Contains("line 4: the length of a list cannot be a float"));
    CHECK_THAT(said("element face 1\nproperty int vertex_indices\n"),
               Contains("line 3: the element 'face' has no list 'vertex_indices'"));
    CHECK_THAT(refusal_of("a.ply", "ply\n" + vertex + "end_header\n"), Contains("the header has no line 'format'"));
    CHECK_THAT(refusal_of("a.ply", "ply\nformat ascii 1.0\n" + vertex), Contains("a.ply: 'end_header' is missing in "));
}

TEST_CASE("a PLY file that promises more than it holds is refused before room is made", "[mesh][surface][broken]") {
    const std::string faces = "element face 1\nproperty list uint int vertex_indices\nend_header\n";
    std::string bytes = ply("binary_little_endian", faces);
    for (const float x : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) append_bytes(bytes, x);
    append_bytes(bytes, std::uint32_t{4'000});
    for (const std::int32_t v : {0, 1, 2}) append_bytes(bytes, v);
    CHECK_THAT(refusal_of("a.ply", bytes),
               Contains("a.ply: byte ") && Contains("face 0: a list of 4000 values does not fit into the 12 bytes"));
    CHECK_THAT(refusal_of("a.ply",
                          "ply\nformat ascii 1.0\nelement vertex 900000\nproperty float x\nproperty float y\nproperty "
                          "float z\nend_header\n0 0 0\n"),
               Contains("a.ply: line 3: the file is damaged: it promises 900000 of the element 'vertex' of at least 6 "
                        "bytes each"));
    const std::string text = "0 0 0\n1 0 0\n0 1 0\n";
    CHECK_THAT(refusal_of("a.ply", ply("ascii", faces + text + "4000 0 1 2\n")),
               Contains("a.ply: line 13: face 0: a list of "));
    CHECK_THAT(refusal_of("a.ply", ply("ascii", faces + text + "-3 0 1 2\n")),
               Contains("a.ply: line 13: face 0: a list of -3 values"));
    CHECK_THAT(refusal_of("a.ply", ply("ascii", faces + text + "3 0 1\n")),
               Contains("a.ply: line 13: face 0: the file is truncated: it ends here"));
    CHECK_THAT(refusal_of("a.ply", ply("ascii", faces + text + "3 0 1 2.5\n")),
               Contains("a.ply: line 13: face 0: '2.5' is no whole number"));
    CHECK_THAT(refusal_of("a.ply", ply("ascii", faces + "0 0 zero\n" + text)),
               Contains("a.ply: line 10: vertex 0: 'zero' is no number"));
    CHECK_THAT(refusal_of("a.ply", ply("ascii", faces + text + "3 0 1 2 7\n")),
               Contains("a.ply: line 13: the file goes on behind the last item"));
}

TEST_CASE("PLY strips of triangles come in as triangles that face the same way", "[mesh][surface][broken]") {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nelement edge 1\nproperty int vertex1\n"
        "property int vertex2\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 2\n0 1\n";
    const SurfaceMesh mesh = read_text("a.ply", text);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4, 0, 1, 2});
    CHECK(mesh.faces.size() == 4);
    CHECK(mesh.n_ignored_elements == 1);
    for (std::int32_t face = 0; face < 4; ++face) {
        const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(mesh.faces[face][i])]; };
        CHECK((corner(1) - corner(0)).cross(corner(2) - corner(0)).z() > 0.0);
    }
}

TEST_CASE("a text STL file with a facet of other than three vertices is refused with its line", "[mesh][surface][broken]") {
    const std::string head = "solid facet vertex\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    const std::string tail = "endloop\nendfacet\nendsolid\n";
    CHECK(read_text("a.stl", head + "vertex 0 1 0\n" + tail).faces.size() == 1);
    CHECK_THAT(refusal_of("a.stl", head + tail), Contains("a.stl: line 7: facet 0: it has 2 vertices, 3 are needed."));
    CHECK_THAT(refusal_of("a.stl", head + "vertex 0 1 0\nvertex 0 1 1\n" + tail),
               Contains("a.stl: line 7: facet 0: it has more than 3 vertices."));
    CHECK_THAT(refusal_of("a.stl", head + "vertex 0 1 O\n" + tail), Contains("a.stl: line 6: 'O' is no number of a double"));
    CHECK_THAT(refusal_of("a.stl", head + "vertices 0 1 0\n" + tail),
               Contains("a.stl: line 6: facet 0: 'vertices' is no word of a facet."));
    CHECK_THAT(refusal_of("a.stl", head + "vertex 0 1 0\nendloop\nendfacet\n"),
               Contains("line 8: the file is truncated: 'endsolid' is missing behind 1 facets."));
    CHECK_THAT(refusal_of("a.stl", "solid\nvertex 0 0 0\nendsolid\n"), Contains("line 2: 'vertex' stands outside a facet."));
    CHECK(std::isnan(
        read_text("a.stl", head + "vertex 0 1 nan\n" + tail).vertices[2].z()));  // kept, for the health report to judge
}
