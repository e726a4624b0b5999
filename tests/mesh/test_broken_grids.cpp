// VTU, VTP and MSH: what a file promises is weighed against its size before room is made for it.
#include <array>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>

#include "abut/mesh/io/read_gmsh.hpp"
#include "abut/mesh/io/read_vtu.hpp"
#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
using Catch::Matchers::Contains;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

const std::string tetrahedron_vtu =
    "<?xml version=\"1.0\"?>\n<!-- <Piece NumberOfPoints=\"9999999\"> -->\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
    "<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells='1'>\n<Points>\n"
    "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>\n"
    "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells>\n"
    "</Piece></UnstructuredGrid></VTKFile>\n";

const std::string triangle_vtp =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
    "<PolyData>\n<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>\n"
    "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n"
    "</Piece></PolyData></VTKFile>\n";

/// What read_surface says; the reader of volumes must refuse the file, too.
std::string said_of(const std::string& file, const std::string& text) {
    const ScratchFolder folder;
    save(folder / file, text);
    const std::string said = complaint_about(folder / file);
    if (file == "a.vtu" && said != "nothing") CHECK_THROWS_AS(read_vtu<3>(folder / file), MeshError);
    if (file == "a.msh" && said != "nothing") CHECK_THROWS_AS(read_gmsh<3>(folder / file), MeshError);
    return said;
}

/// Numbers in this machine's order of bytes or the other one, and text as it is.
class BinaryMsh {
public:
    explicit BinaryMsh(bool foreign = false) : foreign_(foreign) {}
    BinaryMsh& text(const std::string& piece) {
        bytes += piece;
        return *this;
    }
    template <class Value>
    BinaryMsh& values(std::initializer_list<Value> numbers) {
        for (const Value number : numbers) {
            std::string piece;
            append_bytes(piece, number);
            bytes += foreign_ ? std::string(piece.rbegin(), piece.rend()) : piece;
        }
        return *this;
    }
    std::string bytes;

private:
    bool foreign_;
};

struct Promises {
    std::string nodes = "4", elements = "1";
    std::int32_t type = 4, n_in_block = 1, n_tags = 2, one = 1;
    bool foreign = false;
};

/// A tetrahedron in format 2.2.
std::string binary_msh(const Promises& promises) {
    BinaryMsh file(promises.foreign);
    file.text("$MeshFormat\n2.2 1 8\n").values({promises.one}).text("\n$EndMeshFormat\n$Nodes\n" + promises.nodes + "\n");
    for (const int node : {1, 2, 3, 4})
        file.values({node}).values({node == 2 ? 1.0 : 0.0, node == 3 ? 1.0 : 0.0, node == 4 ? 1.0 : 0.0});
    file.text("\n$EndNodes\n$Elements\n" + promises.elements + "\n")
        .values({promises.type, promises.n_in_block, promises.n_tags});
    return file.values({1, 1, 1, 1, 2, 3, 4}).text("\n$EndElements\n").bytes;
}

const std::string text_msh =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
    "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

}  // namespace

TEST_CASE("a VTU file whose attributes promise more than its size can hold is refused by name and line",
          "[mesh][files][broken]") {
    CHECK(said_of("a.vtu", tetrahedron_vtu) == "nothing");
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "NumberOfPoints=\"4\"", "NumberOfPoints=\"100000\"")),
               Contains("a.vtu: line 5: the file is damaged: it promises 100000 as NumberOfPoints in ") &&
                   Contains(" bytes. Write the mesh again."));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "NumberOfCells='1'", "NumberOfCells='100000'")),
               Contains("a.vtu: line 5: the file is damaged: it promises 100000 as NumberOfCells in "));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "NumberOfComponents=\"3\"", "NumberOfComponents=\"100000\"")),
               Contains("a.vtu: line 7: the file is damaged: the array '' of 100000 components promises 400000 values"));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "Name=\"types\"", "Name=\"types\" NumberOfComponents=\"100000\"")),
               Contains("a.vtu: line 10: the file is damaged: the array 'types' of 100000 components"));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "<Piece NumberOfPoints=\"4\"",
                                         "<FieldData><DataArray type=\"Int8\" Name=\"t\" NumberOfTuples=\"100000\" "
                                         "format=\"binary\"></DataArray></FieldData>\n<Piece NumberOfPoints=\"4\"")),
               Contains("a.vtu: line 5: the file is damaged: the array 't' of 1 components promises 100000 values"));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, ">4</DataArray>", ">100000</DataArray>")),
               Contains("a.vtu: line 9: the file is damaged: the offset 100000 is none of vertices of cells"));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, ">0 1 2 3<", ">0 1 2 -<")),
               Contains("a.vtu: line 8: the array 'connectivity' holds '-', a number of the type 'Int64' is needed."));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, ">10<", "><")),
               Contains("line 10: the array 'types' has 0 values, 1 are needed."));
    for (const std::string type : {"300", "-1", "10.0", "100000100000", "nan"})
        CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, ">10<", ">" + type + "<")),
                   Contains("line 10: the array 'types' holds '" + type + "', a number of the type 'UInt8' is needed."));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "Name=\"types\"", "Name=\"offsets\"")),
               Contains("line 10: there are two arrays 'offsets'"));
    CHECK_THAT(said_of("a.vtu",
                       replaced(tetrahedron_vtu, "Name=\"connectivity\"", "Name=\"connectivity\" NumberOfComponents=\"0\"")),
               Contains("line 8: the array 'connectivity' has 0 values of the type 'Int64', 4 whole numbers are needed."));
    CHECK_THAT(said_of("a.vtu", replaced(tetrahedron_vtu, "NumberOfPoints=\"4\"", "NumberOfPoints=\"4e0\"")),
               Contains("a.vtu: line 5: NumberOfPoints is '4e0', a whole number of at least 0 is needed."));
}

TEST_CASE("a VTU file that says it is compressed may promise as much as its method can shrink, and no more",
          "[mesh][files][broken]") {
    const std::string compressed =
        replaced(tetrahedron_vtu, " header_type", " compressor=\"vtkZLibDataCompressor\" header_type");
    const auto with_points = [&](std::size_t n) {
        return replaced(compressed, "NumberOfPoints=\"4\"", "NumberOfPoints=\"" + std::to_string(n) + "\"");
    };
    CHECK_THAT(said_of("a.vtu", with_points(1100 * compressed.size())), Contains("as NumberOfPoints in "));
    CHECK_THAT(said_of("a.vtu", with_points(10 * compressed.size())),
               Contains("a.vtu: ") && !Contains("as NumberOfPoints in "));
}

TEST_CASE("a VTU file whose compressed data promise more than it can hold is refused", "[mesh][files][broken]") {
    const ScratchFolder folder;
    write_vtu(structured_box<3>({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, CellShape::tetrahedron), folder / "whole.vtu");
    std::ifstream file(folder / "whole.vtu", std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    CHECK(said_of("a.vtu", whole) == "nothing");
    const auto data = whole.find('_', whole.find("<AppendedData")) + 1;  // the last array is stored first
    for (const std::size_t number : {0, 1}) {                            // of blocks; of bytes of a block
        std::string damaged = whole;
        damaged.replace(data + 4 * number, 4, "\xF0\xF0\xF0\x70");
        CHECK_THAT(said_of("a.vtu", damaged),
                   Contains("a.vtu: line ") && Contains("the file is damaged: the data of the array 'types' promise "));
    }
    std::string damaged = whole;
    damaged.replace(data + 12, 4, "\xF0\xF0\xF0\x70");  // the bytes of the first block as it is stored
    CHECK_THAT(said_of("a.vtu", damaged), Contains("the file is damaged: the blocks of the array 'types' end behind the "));
    CHECK_THAT(said_of("a.vtu", replaced(whole, "raw\">", "raw\"><")),
               Contains("a.vtu: line ") && Contains("'_' does not follow <AppendedData>"));
}

TEST_CASE("a VTP file whose arrays share their data is refused where all together are more than it can hold",
          "[mesh][files][broken]") {
    const ScratchFolder folder;
    SurfaceMesh mesh;
    for (int i = 0; i < 30'000; ++i) mesh.vertices.push_back({0, 0, 0});
    mesh.faces.append(std::array{0, 0, 0});
    write_vtp(mesh.soup(), folder / "whole.vtp");
    std::ifstream file(folder / "whole.vtp", std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const std::string before = " format=\"appended\" offset=\"";
    const std::size_t begin = whole.find(before, whole.find("Name=\"Points\"")) + before.size();
    const std::string offset = whole.substr(begin, whole.find('"', begin) - begin);
    const auto with_arrays = [&](int n) {
        std::string arrays;
        for (int i = 0; i < n; ++i)
            arrays += "<DataArray type=\"Float64\" Name=\"d" + std::to_string(i) +
                      "\" NumberOfComponents=\"3\" format=\"appended\" offset=\"" + offset + "\"/>";
        return replaced(whole, "<PointData>", "<PointData>" + arrays);
    };
    CHECK(said_of("a.vtp", with_arrays(1)) == "nothing");
    CHECK_THAT(said_of("a.vtp", with_arrays(100)), Contains("a.vtp: line 5: the file is damaged: its arrays, up to 'd"));
}

TEST_CASE("foreign elements within each other are skipped, and entities stay what is written", "[mesh][files][broken]") {
    std::string begins, ends;
    for (int i = 0; i < 65; ++i) {
        begins += "<a>";
        ends += "</a>";
    }
    CHECK(said_of("a.vtp", replaced(triangle_vtp, "<PolyData>", begins + ends + "<PolyData>")) == "nothing");
    const ScratchFolder folder;
    save(folder / "a.vtu", "<!DOCTYPE VTKFile [<!ENTITY e \"twice\">]>\n" +
                               replaced(tetrahedron_vtu, "</Piece>",
                                        "<CellData><DataArray type=\"Int8\" Name=\"body\" format=\"ascii\">5</DataArray>"
                                        "</CellData></Piece><FieldData><DataArray type=\"Int8\" Name=\"body: &e;&e;\" "
                                        "NumberOfTuples=\"1\" format=\"ascii\">5</DataArray></FieldData>"));
    CHECK(read_vtu<3>(folder / "a.vtu").body_names == std::vector<std::string>{"&e;&e;"});
}

TEST_CASE("a grid of equal values, which compress best, is read", "[mesh][files][broken]") {
    const ScratchFolder folder;
    SurfaceMesh mesh;
    for (int i = 0; i < 300'000; ++i) mesh.vertices.push_back({0, 0, 0});
    for (int i = 0; i < 100'000; ++i) mesh.faces.append(std::array{0, 0, 0});
    write_vtp(mesh.soup(), folder / "a.vtp");
    CHECK(std::filesystem::file_size(folder / "a.vtp") < 300'000);
    CHECK(read_surface(folder / "a.vtp").faces.size() == 100'000);
}

TEST_CASE("a VTP file whose attributes promise more than its size can hold is refused by name and line",
          "[mesh][files][broken]") {
    CHECK(said_of("a.vtp", triangle_vtp) == "nothing");
    CHECK_THAT(said_of("a.vtp", replaced(triangle_vtp, "NumberOfPoints=\"3\"", "NumberOfPoints=\"100000\"")),
               Contains("a.vtp: line 3: the file is damaged: it promises 100000 as NumberOfPoints"));
    for (const std::string cells : {"Verts", "Lines", "Strips"})
        CHECK_THAT(
            said_of("a.vtp", replaced(triangle_vtp, "NumberOfPolys", "NumberOf" + cells + "=\"100000\" NumberOfPolys")),
            Contains("a.vtp: line 3: the file is damaged: it promises 100000 as NumberOf" + cells));
}

TEST_CASE("a binary Gmsh file of either order of bytes is read, and of none is refused", "[mesh][files][broken]") {
    const ScratchFolder folder;
    for (const bool foreign : {false, true}) {
        save(folder / "a.msh", binary_msh({.foreign = foreign}));
        const auto mesh = read_gmsh<3>(folder / "a.msh");
        CHECK(mesh.cell_measure == std::vector<double>{1.0 / 6});
        CHECK(mesh.vertex_label == std::vector<std::int64_t>{1, 2, 3, 4});
    }
    CHECK_THAT(said_of("a.msh", binary_msh({.one = 7})),
               Contains("a.msh: byte 20: the file is damaged: its binary part begins with 7, 1 is needed."));
}

TEST_CASE("a binary Gmsh file whose sections are not whole is refused by byte, block by block", "[mesh][files][broken]") {
    for (const auto& [promises, part] :
         {std::pair{Promises{.nodes = "100000"}, "it promises 100000 as the number of nodes"},
          {Promises{.nodes = "3"}, "stands where '$EndNodes' must follow what the section promises"},
          {Promises{.nodes = "many"}, "'many' is no whole number of 64 bits, the number of nodes is needed"},
          {Promises{.elements = "100000", .n_in_block = 100'000}, "it promises 100000 as the number of elements"},
          {Promises{.elements = "2"}, "an element has the type "},
          {Promises{.n_in_block = 0}, "a block has 0 elements"},
          {Promises{.n_in_block = 3}, "its blocks hold at least 0 and 3 elements, the head of the section promises 1"},
          {Promises{.n_tags = -1}, "a block has 1 elements with -1 tags each"},
          {Promises{.type = 77}, "an element has the type 77, Gmsh's 1 to 31 can be read"}}) {
        CAPTURE(part);
        CHECK_THAT(said_of("a.msh", binary_msh(promises)), Contains("a.msh: byte ") && Contains(part));
    }
}

TEST_CASE("a text Gmsh file whose heads promise more than it can hold is refused by line", "[mesh][files][broken]") {
    CHECK(said_of("a.msh", text_msh) == "nothing");
    CHECK_THAT(said_of("a.msh", replaced(text_msh, "1 4 1 4\n", "1 100000 1 4\n")),
               Contains("a.msh: line 5: the file is damaged: it promises 100000 as the number of nodes, "));
    CHECK_THAT(said_of("a.msh", replaced(text_msh, "3 1 0 4\n", "3 1 0 100000\n")),
               Contains("a.msh: line 6: the file is damaged: it promises 100000 as the number of nodes of a block"));
    CHECK_THAT(said_of("a.msh", replaced(text_msh, "1 1 1 1\n", "1 100000 1 1\n")),
               Contains("a.msh: line 17: the file is damaged: it promises 100000 as the number of elements, "));
}

TEST_CASE("all of Gmsh's version 2 is read", "[mesh][files][broken]") {
    const ScratchFolder folder;
    for (const std::string version : {"2", "2.0", "2.1", "2.2"}) {
        save(folder / "a.msh", "$MeshFormat\n" + version +
                                   " 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
                                   "$Elements\n1\n7 4 2 9 1 1 2 3 4\n$EndElements\n");
        const auto mesh = read_gmsh<3>(folder / "a.msh");
        CHECK(mesh.cell_label == std::vector<std::int64_t>{7});
        CHECK(mesh.body_names == std::vector<std::string>{"physical_9"});
    }
}
