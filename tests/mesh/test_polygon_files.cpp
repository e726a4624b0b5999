#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
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

std::string with_crlf(const std::string& text) {
    std::string result;
    for (const char letter : text) result += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
    return result;
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

}  // namespace

TEST_CASE("a cube of quadrangles comes in whole from OBJ, OFF and PLY, whatever ends its lines", "[mesh][surface]") {
    const ScratchFolder folder;
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
    const ScratchFolder folder;
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
    const ScratchFolder folder;
    save(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2\nl 1 2 3\np 4\nf 1 3 4\n");
    const SurfaceMesh mesh = read_surface(folder / "a.obj");
    CHECK(mesh.n_ignored_elements == 2);
    REQUIRE(mesh.faces.size() == 3);
    CHECK(mesh.faces[0].size() == 5);
    CHECK(health_of(mesh).faults[1] == geometry::FaceFault::too_few_corners);
}

TEST_CASE("STL comes in welded, from ASCII and binary, even if that begins with 'solid'", "[mesh][surface]") {
    const ScratchFolder folder;
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

TEST_CASE("keywords of STL may be in capitals", "[mesh][surface]") {
    const ScratchFolder folder;
    const SurfaceMesh ball = sphere_surface({.n_subdivisions = 2});
    std::string capitals = ascii_stl(ball);
    std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    save(folder / "ball.stl", capitals);
    const SurfaceMesh mesh = read_surface(folder / "ball.stl");
    CHECK(mesh.faces.size() == 320);  // 20 of an icosahedron, four times as many twice
    check_is_solid(mesh, health_of(ball).components[0].volume, "ball");
    save(folder / "ball.stl", capitals.substr(0, capitals.rfind("ENDSOLID")));
    CHECK_THAT(complaint_about(folder / "ball.stl"), Contains("ball.stl: line ") && Contains("the file is truncated"));
}

TEST_CASE("a binary STL file keeps corners that are no numbers apart", "[mesh][surface]") {
    const ScratchFolder folder;
    SurfaceMesh bad = sphere_surface({.n_subdivisions = 0});
    bad.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
    save(folder / "bad.stl", binary_stl(bad));
    const auto health = health_of(read_surface(folder / "bad.stl"));
    CHECK(health.n_faults[static_cast<std::size_t>(geometry::FaceFault::not_finite)] == 5);  // around a corner
    CHECK(health.n_usable() == 15);
    CHECK(health.n_bad_vertices == 5);
}

TEST_CASE("a truncated surface file is refused, in any format", "[mesh][surface]") {
    const ScratchFolder folder;
    const SurfaceMesh ball = sphere_surface({.n_subdivisions = 1});
    const double part = GENERATE(0.1, 0.5, 0.9);
    const auto cut = [part](const std::string& whole) {
        return whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size())));
    };
    save(folder / "a.off", cut(cube_off));
    CHECK_THAT(complaint_about(folder / "a.off"),
               Contains("a.off: line ") && Contains("write the mesh again.", Catch::CaseSensitive::No));
    save(folder / "a.ply", cut(cube_ply));
    CHECK_THAT(complaint_about(folder / "a.ply"), Contains("a.ply: "));
    save(folder / "a.stl", cut(ascii_stl(ball)));
    CHECK_THAT(complaint_about(folder / "a.stl"),
               Contains("a.stl: line ") && Contains("write the mesh again.", Catch::CaseSensitive::No));
    save(folder / "b.stl", cut(binary_stl(ball)));
    CHECK_THAT(complaint_about(folder / "b.stl"),
               Contains("b.stl: the file is truncated: 80 triangles need 4084 bytes, it has "));
    write_vtp(ball.soup(), folder / "whole.vtp");
    std::ifstream whole(folder / "whole.vtp", std::ios::binary);
    save(folder / "a.vtp", cut({std::istreambuf_iterator<char>(whole), {}}));
    CHECK_THAT(complaint_about(folder / "a.vtp"), Contains("a.vtp: the file is truncated: '</VTKFile>' is missing after "));
}

TEST_CASE("files that are missing, empty, garbage or of no known kind are refused", "[mesh][surface]") {
    const ScratchFolder folder;
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
    CHECK_THAT(complaint_about(folder / "a.xyz"), Contains("a.xyz: the extension '.xyz' is none of a surface file"));
    CHECK_THAT(complaint_about(folder.path()), !Contains("nothing"));
}

TEST_CASE("text that promises more than it holds, or means no numbers, is refused", "[mesh][surface]") {
    const ScratchFolder folder;
    save(folder / "a.off", "OFF\n2000 2000 0\n0 0 0\n");
    CHECK_THAT(complaint_about(folder / "a.off"),
               Contains("a.off: line 2: the file is damaged: it promises 2000 vertices and 2000 faces in 22 bytes."));
    save(folder / "a.obj", "v 0 0 zero\nf 1 1 1\n");
    CHECK_THAT(complaint_about(folder / "a.obj"),
               Contains("a.obj: line 1: 'zero' is no number of a double, a coordinate is needed."));
    save(folder / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    CHECK_THAT(complaint_about(folder / "b.obj"), Contains("b.obj: line 4: the face names vertex 9, the file has 3."));
    save(folder / "c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    CHECK_THAT(complaint_about(folder / "c.obj"), Contains("c.obj: "));
    save(folder / "d.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
    CHECK_THAT(complaint_about(folder / "d.ply"), Contains("the surface is empty: the file has 0 faces"));
}
