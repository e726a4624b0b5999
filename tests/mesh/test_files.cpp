#include "mesh/laws.hpp"

#include <gmsh.h>

#include <algorithm>
#include <fstream>
#include <tuple>

#include "abut/mesh/io/read_gmsh.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/read_vtu.hpp"
#include "abut/mesh/io/write_vtu.hpp"

using namespace abut;
using namespace abut::mesh;
using Catch::Matchers::Contains;

namespace {

constexpr std::array<int, 6> gmsh_types = {2, 3, 4, 5, 6, 7};  // by CellShape

/// Writes a mesh with Gmsh's own writer: one physical group for the body, one for each boundary group.
template <int Dim>
void save_with_gmsh(const Mesh<Dim>& mesh, const std::filesystem::path& path, double version, bool binary,
                    bool with_bodies = true) {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("saved");
    const int body = gmsh::model::addDiscreteEntity(Dim);
    std::vector<std::size_t> tags(mesh.vertices.size());
    std::iota(tags.begin(), tags.end(), std::size_t{1});
    std::vector<double> x;
    for (const auto& vertex : mesh.vertices)
        for (int i = 0; i < 3; ++i) x.push_back(i < Dim ? vertex[i < Dim ? i : 0] : 0.0);
    gmsh::model::mesh::addNodes(Dim, body, tags, x);
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        std::vector<std::size_t> nodes;
        for (const auto vertex : mesh.cell_vertices[cell]) nodes.push_back(static_cast<std::size_t>(vertex) + 1);
        gmsh::model::mesh::addElementsByType(
            body, gmsh_types[static_cast<std::size_t>(mesh.cell_shape[static_cast<std::size_t>(cell)])], {}, nodes);
    }
    if (with_bodies) gmsh::model::setPhysicalName(Dim, gmsh::model::addPhysicalGroup(Dim, {body}), "the body");
    for (const auto& group : mesh.groups) {
        const int entity = gmsh::model::addDiscreteEntity(Dim - 1);
        for (const auto face : group.faces) {
            std::vector<std::size_t> nodes;
            for (const auto vertex : mesh.face_vertices[face]) nodes.push_back(static_cast<std::size_t>(vertex) + 1);
            gmsh::model::mesh::addElementsByType(entity, Dim == 2 ? 1 : static_cast<int>(nodes.size()) - 1, {}, nodes);
        }
        if (with_bodies) gmsh::model::setPhysicalName(Dim - 1, gmsh::model::addPhysicalGroup(Dim - 1, {entity}), group.name);
    }
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary);
    gmsh::write(path.string());
    gmsh::finalize();
}

template <int Dim>
void check_same_mesh(const Mesh<Dim>& mesh, const Mesh<Dim>& read, std::int64_t first_label, double tolerance) {
    REQUIRE(read.n_cells() == mesh.n_cells());
    REQUIRE(read.n_faces() == mesh.n_faces());
    REQUIRE(read.vertices.size() == mesh.vertices.size());
    for (std::size_t c = 0; c < mesh.cell_measure.size(); ++c) {
        REQUIRE(std::abs(read.cell_measure[c] - mesh.cell_measure[c]) <= tolerance);
        REQUIRE((read.cell_centroid[c] - mesh.cell_centroid[c]).norm() <= tolerance);
    }
    REQUIRE(read.cell_vertices.values.size() == mesh.cell_vertices.values.size());
    // Gmsh hands nodes out by entity, so they are told by their labels.
    for (std::size_t i = 0; i < mesh.cell_vertices.values.size(); ++i)
        REQUIRE(read.vertex_label[static_cast<std::size_t>(read.cell_vertices.values[i])] ==
                mesh.cell_vertices.values[i] + first_label);
    CHECK(read.face_cells == mesh.face_cells);
}

template <int Dim>
void check_same_names(const Mesh<Dim>& mesh, const Mesh<Dim>& read) {
    CHECK(read.body_names == mesh.body_names);
    REQUIRE(read.groups.size() == mesh.groups.size());
    for (const BoundaryGroup& group : mesh.groups) CHECK(read.group(group.name).faces == group.faces);
    CHECK(read.report.n_ignored_elements == 0);
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void save_text(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// Format 2.2: a tetrahedron with one named face.
std::string small_msh() {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"floor\"\n3 9 \"wedge\"\n$EndPhysicalNames\n"
           "$Nodes\n4\n11 0 0 0\n12 1 0 0\n13 0 1 0\n14 0 0 1\n$EndNodes\n"
           "$Elements\n2\n21 2 2 7 1 11 12 13\n22 4 2 9 1 11 12 13 14\n$EndElements\n";
}

/// Format 4.1: a tetrahedron, in no group.
std::string small_msh_41() {
    return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 "
           "1\n$EndNodes\n"
           "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

template <class Read>
std::string complaint(const std::filesystem::path& path, Read read) {
    try {
        (void)read(path);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "nothing";
}

std::string complaint_about_msh(const std::filesystem::path& path) {
    return complaint(path, [](const auto& p) { return read_gmsh<3>(p); });
}
std::string complaint_about_vtu(const std::filesystem::path& path) {
    return complaint(path, [](const auto& p) { return read_vtu<3>(p); });
}

}  // namespace

TEST_CASE("a mesh goes through Gmsh's formats unchanged, names included", "[mesh][files]") {
    const test::ScratchFolder folder;
    const double version = GENERATE(2.2, 4.1);
    const bool binary = GENERATE(false, true);
    CAPTURE(version, binary);
    const MeshOptions as_given{.reorder = false};
    for (const CellShape shape : test::shapes_2d) {
        const auto mesh = test::small_box(shape);
        save_with_gmsh(mesh, folder / "plane.msh", version, binary);
        const auto read = read_gmsh<2>(folder / "plane.msh", as_given);
        check_same_mesh(mesh, read, 1, 1e-14);
        CHECK(read.body_names == std::vector<std::string>{"the body"});
        for (const auto& group : mesh.groups) CHECK(read.group(group.name).faces == group.faces);
    }
    for (const CellShape shape : test::shapes_3d) {
        const auto mesh = test::small_box_3d(shape);
        save_with_gmsh(mesh, folder / "solid.msh", version, binary);
        const auto read = read_mesh<3>(folder / "solid.msh", as_given);
        check_same_mesh(mesh, read, 1, 1e-14);
        CHECK(read.name == (folder / "solid.msh").string());
        for (const auto& group : mesh.groups) CHECK(read.group(group.name).faces == group.faces);
    }
}

TEST_CASE("without physical groups a body is a connected component", "[mesh][files]") {
    const test::ScratchFolder folder;
    const std::vector<Mesh<2>> two = {test::small_box(CellShape::triangle), fan_disc({5, 5}, 1, 6)};
    auto both = combine<2>(two);
    both.groups.clear();
    save_with_gmsh(both, folder / "two.msh", 4.1, false, false);
    const auto read = read_gmsh<2>(folder / "two.msh");
    CHECK(read.body_names == std::vector<std::string>{"body_1", "body_2"});
    CHECK(std::count(read.cell_body.begin(), read.cell_body.end(), 1) == 6);
    write_vtu(both, folder / "two.vtu");
    const auto from_vtu = read_vtu<2>(folder / "two.vtu");
    CHECK(from_vtu.body_names == both.body_names);
    CHECK(std::count(from_vtu.cell_body.begin(), from_vtu.cell_body.end(), 1) == 6);
}

TEST_CASE("physical names and tags of a file are kept", "[mesh][files]") {
    const test::ScratchFolder folder;
    save_text(folder / "a.msh", small_msh());
    const auto mesh = read_gmsh<3>(folder / "a.msh");
    CHECK(mesh.body_names == std::vector<std::string>{"wedge"});
    CHECK(mesh.groups.size() == 1);
    CHECK(mesh.group("floor").faces.size() == 1);
    CHECK(mesh.cell_label == std::vector<std::int64_t>{22});
    CHECK(mesh.vertex_label == std::vector<std::int64_t>{11, 12, 13, 14});
    CHECK(mesh.cell_measure[0] == Approx(1.0 / 6));
}

TEST_CASE("a mesh goes through VTU unchanged, with its groups and the names of its bodies", "[mesh][files]") {
    const test::ScratchFolder folder;
    const MeshOptions as_given{.reorder = false};
    for (const CellShape shape : test::shapes_2d) {
        const auto mesh = test::small_box(shape);
        write_vtu(mesh, folder / "plane.vtu");
        const auto read = read_mesh<2>(folder / "plane.vtu", as_given);
        check_same_mesh(mesh, read, 0, 0.0);
        check_same_names(mesh, read);
    }
    for (const CellShape shape : test::shapes_3d) {
        const auto mesh = test::small_box_3d(shape);
        write_vtu(mesh, folder / "solid.vtu");
        const auto read = read_mesh<3>(folder / "solid.vtu", as_given);
        check_same_mesh(mesh, read, 0, 0.0);
        check_same_names(mesh, read);
    }
}

TEST_CASE("voxels, both orders of wedges and lower cells are read from VTU", "[mesh][files]") {
    const test::ScratchFolder folder;
    const auto file = [](const std::string& connectivity, const std::string& offsets, const std::string& types, int n) {
        return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
               "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
               "<Piece NumberOfPoints=\"8\" NumberOfCells=\"" +
               std::to_string(n) +
               "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
               "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1</DataArray></Points>\n<Cells>\n<DataArray type=\"Int64\" "
               "Name=\"connectivity\" format=\"ascii\">" +
               connectivity + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
               "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
               "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    };
    save_text(folder / "voxel.vtu", file("0 1 2 3 4 5 6 7", "8", "11", 1));
    CHECK(read_vtu<3>(folder / "voxel.vtu").cell_measure[0] == Approx(1.0));
    for (const char* wedge : {"0 1 2 4 5 6", "0 2 1 4 6 5"}) {
        save_text(folder / "wedge.vtu", file(wedge, "6", "13", 1));
        CHECK(read_vtu<3>(folder / "wedge.vtu").cell_measure[0] == Approx(0.5));
    }
    save_text(folder / "mixed.vtu", file("0 1 2 0 1 2 4", "3 7", "5 10", 2));
    const auto mesh = read_vtu<3>(folder / "mixed.vtu");
    CHECK(mesh.n_cells() == 1);
    CHECK(mesh.report.n_ignored_elements == 1);
    CHECK(mesh.report.n_unused_vertices == 4);
    CHECK(mesh.cell_label == std::vector<std::int64_t>{1});
    save_text(folder / "curved.vtu", file("0 1 2 4 3 3 3 3 3 3", "10", "24", 1));
    const auto straight = read_vtu<3>(folder / "curved.vtu");
    CHECK(straight.cell_measure[0] == Approx(1.0 / 6));
    REQUIRE(straight.report.warnings.size() == 1);
    CHECK_THAT(straight.report.warnings[0], Contains("1 elements are of order 2"));
    save_text(folder / "curved.vtu", file("0 1 2 3 4 5", "6", "70", 1));
    CHECK_THAT(complaint_about_vtu(folder / "curved.vtu"),
               Contains("cell 0 has the VTK cell type 70") && Contains("Convert it to straight-sided"));
    const auto complaint_of = [&](const std::string& connectivity, const std::string& offsets) {
        save_text(folder / "range.vtu", file(connectivity, offsets, "10", 1));
        return complaint_about_vtu(folder / "range.vtu");
    };
    CHECK_THAT(complaint_of("0 1 2 99", "4"),
               Contains("range.vtu: cell 0 has the point 99, the file has 8. Write the mesh again."));
    CHECK_THAT(complaint_of("0 1 2 -1", "4"),
               Contains("range.vtu: cell 0 has the point -1, the file has 8. Write the mesh again."));
    CHECK_THAT(complaint_of("0 1 2 4", "7"), Contains("range.vtu: ") && Contains(". Write the mesh again."));
    CHECK_THAT(complaint_of("0 1 2 4", "3"), Contains("range.vtu: ") && Contains(". Write the mesh again."));
}

TEST_CASE("numbers of sets that other programs write to VTU are bodies and groups", "[mesh][files]") {
    const test::ScratchFolder folder;
    // Three tetrahedra, the last apart and in no set; three of their faces, one of them curved, and an edge.
    const auto file = [](const std::string& arrays) {
        return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
               "<Piece NumberOfPoints=\"12\" NumberOfCells=\"7\">\n<Points><DataArray type=\"Float64\" "
               "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1 5 0 0 7 0 0 5 1 0 5 0 1 "
               "9 0 0 10 0 0 9 1 0 9 0 3</DataArray></Points>\n"
               "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 6 7 8 9 10 11 "
               "0 1 2 4 5 6 8 8 8 0 1 3 0 1</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">"
               "4 8 12 15 21 24 26</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">"
               "10 10 10 5 22 5 3</DataArray></Cells>\n<CellData>" +
               arrays + "</CellData></Piece></UnstructuredGrid></VTKFile>\n";
    };
    const auto array = [](const std::string& name, const std::string& values) {
        return "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>";
    };
    const std::string numbers = "7 -3 0 7 9 0 4";
    for (const std::string name : {"gmsh:physical", "cell_tags", "medit:ref", "nastran:ref", "su2:tag", "CellEntityIds"}) {
        CAPTURE(name);
        save_text(folder / "a.vtu", file(array("other", "1 1 1 1 1 1 1") + array(name, numbers)));
        const auto mesh = read_vtu<3>(folder / "a.vtu");
        CHECK(mesh.body_names == std::vector<std::string>{"set_-3", "set_7", "body_1"});
        REQUIRE(mesh.n_cells() == 3);
        for (const auto& [label, body, volume] : {std::tuple{1, 0, 1.0 / 3}, {0, 1, 1.0 / 6}, {2, 2, 0.5}}) {
            const auto cell = static_cast<std::size_t>(std::ranges::find(mesh.cell_label, label) - mesh.cell_label.begin());
            REQUIRE(cell < 3);
            CHECK(mesh.cell_body[cell] == body);
            CHECK(mesh.cell_measure[cell] == Approx(volume));
        }
        REQUIRE(mesh.groups.size() == 2);
        const auto area = [&](const std::string& group) {
            REQUIRE(mesh.group(group).faces.size() == 1);
            return mesh.face_measure[static_cast<std::size_t>(mesh.group(group).faces[0])];
        };
        CHECK(area("set_7") == Approx(0.5));
        CHECK(area("set_9") == Approx(1.0));
        CHECK(mesh.report.n_ignored_elements == 2);
    }
    save_text(folder / "a.vtu", file(array("body", "1 1 1 1 1 1 1") + array("medit:ref", numbers)));  // ours count first
    CHECK(read_vtu<3>(folder / "a.vtu").body_names == std::vector<std::string>{"body_1"});
    save_text(folder / "a.vtu", file("<DataArray type=\"Float64\" Name=\"medit:ref\" format=\"ascii\">"
                                     "7 7.5 0 7 9 0 4</DataArray>"));  // no numbers of sets
    CHECK(read_vtu<3>(folder / "a.vtu").body_names == std::vector<std::string>{"body_1", "body_2", "body_3"});
}

TEST_CASE("files that are missing, empty or something else are refused by name", "[mesh][files]") {
    const test::ScratchFolder folder;
    for (const std::string name : {"a.msh", "a.vtu"}) {
        const auto path = folder / name;
        const auto complain = [&] { return name == "a.msh" ? complaint_about_msh(path) : complaint_about_vtu(path); };
        CHECK(complain() == path.string() + ": there is no such file. Check the path.");
        save_text(path, "");
        CHECK_THAT(complain(), Contains(path.string() + ": the file is empty (0 bytes)."));
        save_text(path, "solid cube\nfacet normal\n");
        CHECK_THAT(complain(), Contains(path.string() + ": is not a "));
        std::filesystem::remove(path);
        std::filesystem::create_directory(path);
        CHECK_THAT(complain(), Contains("is a folder"));
    }
    save_text(folder / "a.stl", "solid");
    CHECK_THROWS_WITH(read_mesh<3>(folder / "a.stl"), Contains("the extension '.stl' is none of a mesh file"));
}

TEST_CASE("a truncated Gmsh file is refused wherever it is cut", "[mesh][files]") {
    const test::ScratchFolder folder;
    const double version = GENERATE(2.2, 4.1);
    const bool binary = GENERATE(false, true);
    save_with_gmsh(test::small_box_3d(CellShape::tetrahedron), folder / "whole.msh", version, binary);
    const std::string whole = text_of(folder / "whole.msh");
    REQUIRE(complaint_about_msh(folder / "whole.msh") == "nothing");
    for (const double part : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
        save_text(folder / "cut.msh", whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
        CHECK_THAT(complaint_about_msh(folder / "cut.msh"),
                   Contains("cut.msh: the file is truncated") || Contains("has the Gmsh format"));
    }
}

TEST_CASE("a Gmsh file with fewer elements than promised is refused", "[mesh][files]") {
    const test::ScratchFolder folder;
    save_text(folder / "a.msh", with_replaced(small_msh(), "22 4 2 9 1 11 12 13 14\n", ""));
    CHECK_THAT(
        complaint_about_msh(folder / "a.msh"),
        Contains("a.msh: line 19: the file is damaged: the tag of an element is missing, '$EndElements' stands there."));
}

TEST_CASE("a Gmsh file whose header promises more than its blocks hold is refused, with both numbers", "[mesh][files]") {
    const test::ScratchFolder folder;
    save_text(folder / "a.msh", small_msh_41());
    REQUIRE(complaint_about_msh(folder / "a.msh") == "nothing");
    save_text(folder / "a.msh", with_replaced(small_msh_41(), "1 1 1 1\n3 1 4 1\n", "1 5 1 1\n3 1 4 1\n"));
    CHECK(complaint_about_msh(folder / "a.msh") ==
          (folder / "a.msh").string() +
              ": the file is damaged: 1 elements could be read, its header promises 5. Write the mesh again.");
}

TEST_CASE("a node that stands twice is read once, with a warning, and refused at two places", "[mesh][files]") {
    const test::ScratchFolder folder;
    save_text(folder / "a.msh", small_msh());
    CHECK(read_gmsh<3>(folder / "a.msh").report.warnings.empty());
    save_text(folder / "a.msh", with_replaced(small_msh(), "$Nodes\n4\n", "$Nodes\n5\n14 0 0 1\n"));
    const auto warnings = read_gmsh<3>(folder / "a.msh").report.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] == "node 14 stands twice, at the same place; nodes of that kind that were skipped: 1");
    save_text(folder / "a.msh", with_replaced(small_msh(), "$Nodes\n4\n", "$Nodes\n5\n14 0 0 2\n"));
    CHECK_THAT(complaint_about_msh(folder / "a.msh"), Contains("a.msh: node 14 stands twice, at two places."));
}

TEST_CASE("elements that are neither cells nor in a boundary group are counted, each once", "[mesh][files]") {
    const test::ScratchFolder folder;
    const auto ignored = [&](const std::string& elements) {
        save_text(folder / "a.msh",
                  with_replaced(small_msh(), "2\n21 2 2 7 1 11 12 13\n22 4 2 9 1 11 12 13 14\n", elements));
        return read_gmsh<3>(folder / "a.msh").report.n_ignored_elements;
    };
    CHECK(ignored("2\n21 2 2 7 1 11 12 13\n22 4 2 9 1 11 12 13 14\n") == 0);
    CHECK(ignored("3\n20 15 2 0 1 11\n21 2 2 7 1 11 12 13\n22 4 2 9 1 11 12 13 14\n") == 1);
    CHECK(ignored("4\n19 1 2 5 1 11 12\n20 2 2 0 2 11 13 14\n21 2 2 7 1 11 12 13\n22 4 2 9 1 11 12 13 14\n") == 2);
}

TEST_CASE("a face in two boundary groups is in both, and no reason to count less", "[mesh][files]") {
    const test::ScratchFolder folder;
    const std::string text = with_replaced(
        small_msh_41(), "$Nodes\n",
        "$Entities\n0 1 1 1\n1 0 0 0 1 0 0 0 0\n1 0 0 0 1 1 0 2 7 8 0\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n");
    save_text(folder / "a.msh",
              with_replaced(text, "1 1 1 1\n3 1 4 1\n", "3 3 1 3\n1 1 1 1\n3 1 2\n2 1 2 1\n2 1 2 3\n3 1 4 1\n"));
    const auto mesh = read_gmsh<3>(folder / "a.msh");
    CHECK(mesh.group("physical_7").faces == mesh.group("physical_8").faces);
    CHECK(mesh.group("physical_7").faces.size() == 1);
    CHECK(mesh.report.n_ignored_elements == 1);  // the edge
}

TEST_CASE("a physical group without cells and groups of one name are refused", "[mesh][files]") {
    const test::ScratchFolder folder;
    const auto said_of = [&](const std::string& text) {
        save_text(folder / "a.msh", text);
        return complaint_about_msh(folder / "a.msh");
    };
    const std::string with_empty_volume = with_replaced(
        small_msh_41(), "$Nodes\n", "$Entities\n0 0 0 2\n1 0 0 0 1 1 1 1 7 0\n2 0 0 0 1 1 1 1 8 0\n$EndEntities\n$Nodes\n");
    CHECK_THAT(said_of(with_empty_volume),
               Contains("a.msh: body 'physical_8' has 0 cells of dimension 3, at least 1 is needed."));
    // A group without a name is called by its tag, which may be the name of another one.
    const std::string text =
        with_replaced(small_msh(), "2\n21 2 2 7 1 11 12 13\n", "3\n21 2 2 7 1 11 12 13\n23 2 2 8 2 11 13 14\n");
    CHECK(said_of(text) == "nothing");
    CHECK_THAT(said_of(with_replaced(text, "floor", "physical_8")),
               Contains("a.msh: 2 boundary groups are called 'physical_8', each needs a name of its own."));
}

TEST_CASE("a body without a group does not take the name of one that has it", "[mesh][files]") {
    const test::ScratchFolder folder;
    save_text(folder / "a.msh",
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 9 \"body_1\"\n$EndPhysicalNames\n"
              "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 5 0 0\n6 6 0 0\n7 5 1 0\n8 5 0 1\n$EndNodes\n"
              "$Elements\n2\n1 4 2 9 1 1 2 3 4\n2 4 2 0 2 5 6 7 8\n$EndElements\n");
    CHECK(read_gmsh<3>(folder / "a.msh").body_names == std::vector<std::string>{"body_1", "body_2"});
}

TEST_CASE("what is wrong inside a Gmsh file is said with the numbers of the file", "[mesh][files]") {
    const test::ScratchFolder folder;
    const auto said_of = [&](const std::string& text) {
        save_text(folder / "a.msh", text);
        return complaint_about_msh(folder / "a.msh");
    };
    CHECK(said_of(small_msh()) == "nothing");
    CHECK_THAT(said_of(with_replaced(small_msh(), "2.2 0 8", "1.0 0 8")),
               Contains("has the Gmsh format '1.0', 2.0 to 2.2 and 4.1 can be read."));
    CHECK_THAT(said_of(with_replaced(small_msh(), "14 0 0 1", "14 0 0 nan")),
               Contains("a.msh: vertex 14 has the z coordinate nan, a finite number is needed. Mesh the part again."));
    CHECK_THAT(said_of(with_replaced(small_msh(), "11 12 13 14\n", "11 12 13 77\n")),
               Contains("a.msh: line 19: element 22 has the node 77, which is not in the file."));
}

TEST_CASE("the dimension of the file must be that asked for", "[mesh][files]") {
    const test::ScratchFolder folder;
    save_with_gmsh(test::small_box_3d(CellShape::tetrahedron), folder / "solid.msh", 4.1, false);
    save_with_gmsh(test::small_box(CellShape::triangle), folder / "plane.msh", 4.1, false);
    CHECK_THROWS_WITH(read_gmsh<2>(folder / "solid.msh"),
                      Contains("solid.msh: 360 cells of dimension 3 in what should be a mesh of dimension 2."));
    CHECK_THROWS_WITH(read_gmsh<3>(folder / "plane.msh"),
                      Contains("plane.msh: the mesh is empty: 0 cells of dimension 3 (and 24 of dimension 2)"));
    write_vtu(test::small_box_3d(CellShape::tetrahedron), folder / "solid.vtu");
    CHECK_THROWS_WITH(
        read_vtu<2>(folder / "solid.vtu"),
        Contains(
            "z runs from 0 to 3 m in a mesh of dimension 2, 3.74166e-06 m of spread is allowed. Put the mesh into a plane"));
}

TEST_CASE("a truncated or damaged VTU file is refused", "[mesh][files]") {
    const test::ScratchFolder folder;
    write_vtu(test::small_box_3d(CellShape::tetrahedron), folder / "whole.vtu");
    const std::string whole = text_of(folder / "whole.vtu");
    for (const double part : {0.3, 0.6, 0.99}) {
        save_text(folder / "cut.vtu", whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
        CHECK_THAT(
            complaint_about_vtu(folder / "cut.vtu"),
            Contains("cut.vtu: the file is truncated: '</VTKFile>' is missing after ") && Contains("Write the mesh again."));
    }
    std::string damaged = whole;
    for (std::size_t i = 0; i < 200; ++i) damaged[damaged.size() / 2 + i] = 'x';
    save_text(folder / "damaged.vtu", damaged);
    CHECK_THAT(complaint_about_vtu(folder / "damaged.vtu"),
               Contains("damaged.vtu: line ") && Contains("is not what zlib makes of its bytes. Write the mesh again."));
}
