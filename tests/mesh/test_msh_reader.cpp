// MSH is read by our own reader: it finds what Gmsh's finds, in all that Gmsh writes, and outlives what Gmsh does not.
#include <gmsh.h>

#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "abut/mesh/io/msh_file.hpp"
#include "abut/mesh/io/read_gmsh.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
using Catch::Matchers::Contains;

namespace {

/// Of one element: Gmsh's type, the places of its nodes, the names of its groups.
struct Element {
    int type;
    std::vector<std::array<double, 3>> places;
    std::set<std::string> groups;
    friend bool operator==(const Element&, const Element&) = default;
};
/// By dimension and tag.
using Elements = std::map<std::pair<int, std::int64_t>, Element>;

class OpenGmsh {
public:
    OpenGmsh() {
        gmsh::initialize();
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::model::add("test");
    }
    ~OpenGmsh() { gmsh::finalize(); }
    OpenGmsh(const OpenGmsh&) = delete;
    OpenGmsh& operator=(const OpenGmsh&) = delete;
};

std::set<std::string> groups_of_entity(int dimension, int entity) {
    std::vector<int> tags;
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
    std::set<std::string> names;
    for (const int tag : tags) {
        std::string name;
        gmsh::model::getPhysicalName(dimension, std::abs(tag), name);
        names.insert(name.empty() ? "physical_" + std::to_string(std::abs(tag)) : name);
    }
    return names;
}

/// As Gmsh reads it; of nodes those that our reader keeps, the corners.
Elements read_by_gmsh(const std::filesystem::path& path) {
    const OpenGmsh open;
    gmsh::merge(path.string());
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters);
    std::map<std::size_t, std::array<double, 3>> place;
    for (std::size_t i = 0; i < tags.size(); ++i) place[tags[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
    Elements elements;
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    for (const auto& [dimension, entity] : entities) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> labels, nodes;
        gmsh::model::mesh::getElements(types, labels, nodes, dimension, entity);
        const auto groups = groups_of_entity(dimension, entity);
        for (std::size_t t = 0; t < types.size(); ++t) {
            const std::size_t n = labels[t].empty() ? 0 : nodes[t].size() / labels[t].size();
            for (std::size_t i = 0; i < labels[t].size(); ++i) {
                Element element{types[t], {}, groups};
                for (std::size_t k = 0; k < msh_type(types[t])->n_corners; ++k)
                    element.places.push_back(place.at(nodes[t][i * n + k]));
                elements[{dimension, static_cast<std::int64_t>(labels[t][i])}] = element;
            }
        }
    }
    return elements;
}

Elements read_by_us(const std::filesystem::path& path) {
    const MshFile file = read_msh_file(path);
    Elements elements;
    for (const MshBlock& block : file.blocks)
        for (std::size_t i = 0; i < block.size(); ++i) {
            Element element{block.type.number, {}, {}};
            for (std::size_t k = 0; k < block.type.n_corners; ++k) {
                const auto& x = file.vertices[static_cast<std::size_t>(block.nodes[i * block.type.n_corners + k])];
                element.places.push_back({x[0], x[1], x[2]});
            }
            for (const auto group : block.groups) element.groups.insert(file.name_of({block.type.dimension, group}));
            elements[{block.type.dimension, block.labels[i]}] = element;
        }
    return elements;
}

void name(int dimension, const std::vector<int>& entities, const std::string& text) {
    const int tag = gmsh::model::addPhysicalGroup(dimension, entities);
    if (!text.empty()) gmsh::model::setPhysicalName(dimension, tag, text);
}

/// Two balls and a box in space, in groups with and without names, one body in none; and squares in the plane.
void make_bodies(int dimension, int order) {
    namespace occ = gmsh::model::occ;
    if (dimension == 3) {
        occ::addBox(0, 0, 0, 1, 1, 1);
        occ::addSphere(3, 0, 0, 0.5);
        occ::addSphere(6, 0, 0, 0.5);
    } else {
        occ::addRectangle(0, 0, 0.25, 1, 1);
        occ::addDisk(3, 0, 0.25, 0.5, 0.5);
        occ::addDisk(6, 0, 0.25, 0.5, 0.5);
    }
    occ::synchronize();
    name(dimension, {1}, "a body with blanks");
    name(dimension, {2}, "");
    name(dimension - 1, {1}, "left");
    name(dimension - 1, {1, 2}, dimension == 3 ? "" : "left and more");
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
    gmsh::model::mesh::generate(dimension);
    if (order > 1) gmsh::model::mesh::setOrder(order);
}

/// A tetrahedron whose nodes and elements have tags far apart.
void make_gaps() {
    const int volume = gmsh::model::addDiscreteEntity(3, 77), surface = gmsh::model::addDiscreteEntity(2, 5);
    gmsh::model::mesh::addNodes(3, volume, {10, 500, 2'000'000, 7}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    gmsh::model::mesh::addElementsByType(volume, 4, {900'000}, {10, 500, 2'000'000, 7});
    gmsh::model::mesh::addElementsByType(surface, 2, {3}, {10, 500, 2'000'000});
    name(3, {volume}, "body");
    name(2, {surface}, "floor");
}

/// Two opposite sides of a square that are each other's image, and a field on its elements: sections that are skipped.
void make_periodic() {
    gmsh::model::occ::addRectangle(0, 0, 0, 1, 1);
    gmsh::model::occ::synchronize();
    gmsh::model::mesh::setPeriodic(1, {2}, {4}, {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    name(2, {1}, "square");
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
    gmsh::model::mesh::generate(2);
}

/// Elements in no group are saved in format 4.1 alone: in 2.2 Gmsh would leave all groups out.
void write(const std::filesystem::path& path, double version, bool binary, bool save_all) {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary);
    gmsh::option::setNumber("Mesh.SaveAll", save_all);
    gmsh::write(path.string());
}

std::string said_of(const std::string& text) {
    const ScratchFolder folder;
    save(folder / "a.msh", text);
    const std::string said = complaint_about(folder / "a.msh");
    CHECK_THROWS_AS(read_gmsh<2>(folder / "a.msh"), MeshError);
    CHECK_THROWS_AS(read_gmsh<3>(folder / "a.msh"), MeshError);
    return said;
}

const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string elements = "$Elements\n1\n7 4 2 9 1 1 2 3 4\n$EndElements";

}  // namespace

TEST_CASE("our reader of MSH finds the elements, nodes and groups that Gmsh's reader finds", "[mesh][files][msh]") {
    const ScratchFolder folder;
    const auto path = folder / "a.msh";
    const double version = GENERATE(2.2, 4.1);
    const bool binary = GENERATE(false, true);
    CAPTURE(version, binary);
    struct Model {
        const char* what;
        void (*make)();
        bool has_two_groups_of_an_entity;
    };
    for (const auto& model : {Model{"solids", [] { make_bodies(3, 1); }, true},
                              {"plane", [] { make_bodies(2, 1); }, true},
                              {"order 2", [] { make_bodies(3, 2); }, true},
                              {"gaps", make_gaps, false},
                              {"periodic", make_periodic, false}}) {
        // Format 2.2 has one group for an element: Gmsh writes such an element twice, and gives both groups to its entity.
        if (version < 4 && model.has_two_groups_of_an_entity) continue;
        CAPTURE(model.what);
        {
            const OpenGmsh open;
            model.make();
            write(path, version, binary, version > 4.0);
        }
        const Elements wanted = read_by_gmsh(path), found = read_by_us(path);
        CHECK(wanted.size() > 1);
        CHECK(found == wanted);
    }
}

TEST_CASE("a mesh that Gmsh has cut into parts is that of the whole: a cut is no group", "[mesh][files][msh]") {
    const ScratchFolder folder;
    const int dimension = GENERATE(2, 3);
    const bool binary = GENERATE(false, true), ghosts = GENERATE(false, true);
    CAPTURE(dimension, binary, ghosts);
    {
        const OpenGmsh open;
        make_bodies(dimension, 1);
        write(folder / "whole.msh", 4.1, binary, false);
        gmsh::option::setNumber("Mesh.PartitionCreateGhostCells", ghosts);
        gmsh::model::mesh::partition(3);
        write(folder / "parts.msh", 4.1, binary, false);
    }
    const auto check_alike = [](const auto& whole, const auto& parts) {
        CHECK(parts.n_cells() == whole.n_cells());
        CHECK(parts.boundary_faces.size() == whole.boundary_faces.size());
        CHECK(parts.body_names == whole.body_names);
        REQUIRE(parts.groups.size() == whole.groups.size());
        for (const auto& group : whole.groups) CHECK(parts.group(group.name).faces.size() == group.faces.size());
    };
    if (dimension == 2)
        check_alike(read_gmsh<2>(folder / "whole.msh"), read_gmsh<2>(folder / "parts.msh"));
    else
        check_alike(read_gmsh<3>(folder / "whole.msh"), read_gmsh<3>(folder / "parts.msh"));
}

TEST_CASE("a version is a number, whatever its digits", "[mesh][files][msh]") {
    const ScratchFolder folder;
    const std::string version = GENERATE("2", "2.0", "2.000000", "2.20");
    save(folder / "a.msh", "$MeshFormat\n" + version + " 0 8\n$EndMeshFormat\n" + nodes + elements);
    CHECK(read_gmsh<3>(folder / "a.msh").n_cells() == 1);
}

TEST_CASE("an element of format 2.2 in two groups is in both", "[mesh][files][msh]") {
    const ScratchFolder folder;
    {
        const OpenGmsh open;
        make_bodies(3, 1);
        write(folder / "a.msh", 2.2, false, false);
        write(folder / "b.msh", 4.1, false, false);
    }
    const auto two = read_gmsh<3>(folder / "a.msh"), four = read_gmsh<3>(folder / "b.msh");
    CHECK(two.n_cells() == four.n_cells());
    CHECK(two.body_names == four.body_names);
    REQUIRE(two.groups.size() == four.groups.size());
    for (const auto& group : four.groups) CHECK(two.group(group.name).faces.size() == group.faces.size());
}

TEST_CASE("files that lack a word are refused by the line where the next one stands", "[mesh][files][msh]") {
    const auto without = [](std::string text, const std::string& line, const std::string& shorter) {
        const auto at = text.find(line);
        REQUIRE(at != std::string::npos);
        return text.replace(at, line.size(), shorter);
    };
    CHECK_THAT(said_of(head + without(nodes, "4 0 0 1", "4 0 1") + elements),
               Contains("a.msh: line 10: the file is damaged: a coordinate is missing, '$EndNodes' stands there."));
    CHECK_THAT(
        said_of(head + nodes + without(elements, "1 2 3 4", "1 2 3")),
        Contains("a.msh: line 14: the file is damaged: a node of an element is missing, '$EndElements' stands there."));
    CHECK_THAT(said_of("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n"
                       "0 0\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n"),
               Contains("a.msh: line 15: the file is damaged: a coordinate is missing, '$EndNodes' stands there."));
    CHECK_THAT(said_of(head + "$PhysicalNames\n1\n4 9 \"body\"\n$EndPhysicalNames\n" + nodes + elements),
               Contains("a.msh: line 6: a physical group has the dimension 4, 0 to 3 are allowed"));
}

TEST_CASE("the last line needs no end, lines may end as on other systems, and foreign sections are skipped",
          "[mesh][files][msh]") {
    const ScratchFolder folder;
    std::string crlf;
    for (const char letter : head + nodes + elements + "\n")
        crlf += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
    for (const std::string& text :
         {head + nodes + elements, crlf, head + "$Comments\n$Nodes of nothing\n$EndComments\n" + nodes + elements,
          "$Comments\nmade by hand\n$EndComments\n$Comments\n$EndComments\n" + head + nodes + elements,
          head + nodes + elements + "\n$ElementData\n1\n\"p\"\n0\n3\n0\n1\n1\n7 2.5\n$EndElementData"}) {
        save(folder / "a.msh", text);
        const auto mesh = read_gmsh<3>(folder / "a.msh");
        CHECK(mesh.cell_label == std::vector<std::int64_t>{7});
        CHECK(mesh.body_names == std::vector<std::string>{"physical_9"});
        CHECK(mesh.report.warnings.empty());
    }
    save(folder / "a.msh", head + "lost words\n" + nodes + elements);
    CHECK(
        read_gmsh<3>(folder / "a.msh").report.warnings ==
        std::vector<std::string>{"line 4: 'lost' is in no section of a Gmsh file; lines of that kind that were skipped: 1"});
    CHECK_THAT(said_of(head + nodes + elements + "\n$ElementData\n1\n"),
               Contains("the file is truncated: '$EndElementData' is missing"));
    // A file of somebody else, that was given by mistake: none of its words is told.
    const std::string stranger = said_of("user:secret\nand more\n");
    CHECK_THAT(stranger, Contains("it does not start with '$MeshFormat'") && !Contains("secret"));
    CHECK_THAT(said_of(head + nodes + nodes + elements), Contains("there is a second section $Nodes"));
}

TEST_CASE("binary data need no end of a line behind them", "[mesh][files][msh]") {
    const ScratchFolder folder;
    const double version = GENERATE(2.2, 4.1);
    {
        const OpenGmsh open;
        make_gaps();
        write(folder / "a.msh", version, true, true);
    }
    std::ifstream file(folder / "a.msh", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const Elements wanted = read_by_us(folder / "a.msh");
    std::size_t n_joined = 0;
    for (const char* end : {"\n$EndNodes", "\n$EndElements", "\n$EndEntities"})
        if (const auto at = bytes.find(end); at != std::string::npos) {
            bytes.erase(at, 1);
            ++n_joined;
        }
    CHECK(n_joined >= 2);
    if (bytes.ends_with('\n')) bytes.pop_back();
    save(folder / "a.msh", bytes);
    CHECK(read_by_us(folder / "a.msh") == wanted);
}

TEST_CASE("bodies that share vertices have one surface, and are two bodies of a mesh only where each gets its own",
          "[mesh][files][msh]") {
    const ScratchFolder folder;
    // Two tetrahedra on either side of a triangle, which is named, too.
    save(folder / "a.msh", head +
                               "$PhysicalNames\n2\n3 1 \"left\"\n3 2 \"right\"\n$EndPhysicalNames\n"
                               "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n$EndNodes\n"
                               "$Elements\n3\n1 4 2 1 1 1 2 3 4\n2 4 2 2 2 1 3 2 5\n3 2 2 3 3 1 2 3\n$EndElements\n");
    const SurfaceMesh surface = read_surface(folder / "a.msh");
    CHECK(surface.body_names == std::vector<std::string>{"left+right"});
    CHECK(surface.faces.size() == 6);
    CHECK(health_of(surface).sound());
    CHECK_THROWS_WITH(read_gmsh<3>(folder / "a.msh"),
                      Contains("bodies 'left' and 'right' share vertex") && Contains("separated as the file is read"));
    const Mesh<3> mesh = read_gmsh<3>(folder / "a.msh", {.shared_vertices = SharedVertices::separate});
    CHECK(mesh.report.joined_bodies == std::vector<std::array<std::int32_t, 2>>{{0, 1}});
    CHECK(mesh.groups.front().faces.size() == 2);
}

TEST_CASE("cells of format 2.2 have each their own group, whatever their entity", "[mesh][files][msh]") {
    const ScratchFolder folder;
    save(folder / "a.msh",
         head +
             "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 5 0 0\n6 6 0 0\n7 5 1 0\n8 5 0 1\n$EndNodes\n"
             "$Elements\n2\n1 4 2 9 1 1 2 3 4\n2 4 2 8 1 5 6 7 8\n$EndElements\n");
    CHECK(read_gmsh<3>(folder / "a.msh").body_names == std::vector<std::string>{"physical_8", "physical_9"});
}

TEST_CASE("a mesh of order 2 comes in by its corners, with a warning, and one of order 3 is refused", "[mesh][files][msh]") {
    const ScratchFolder folder;
    for (const int order : {1, 2, 3}) {
        const OpenGmsh open;
        make_bodies(3, order);
        write(folder / ("order_" + std::to_string(order) + ".msh"), 4.1, false, true);
    }
    const auto one = read_gmsh<3>(folder / "order_1.msh"), two = read_gmsh<3>(folder / "order_2.msh");
    CHECK(two.cell_measure == one.cell_measure);
    CHECK(two.groups.size() == one.groups.size());
    CHECK(one.report.warnings.empty());
    REQUIRE(two.report.warnings.size() == 1);
    CHECK(two.report.warnings[0] ==
          std::to_string(one.n_cells()) +
              " elements are of order 2: their nodes between corners are left out, so that edges and faces are straight");
    CHECK_THROWS_WITH(read_gmsh<3>(folder / "order_3.msh"),
                      Contains("is a tetrahedron of order 3, those of orders 1 and 2 can be read. Mesh the part again with "
                               "gmsh -order 1."));
    CHECK(read_surface(folder / "order_2.msh").faces.size() == read_surface(folder / "order_1.msh").faces.size());
}

TEST_CASE("pipes, devices and folders are refused before a byte is read", "[mesh][files]") {
    const ScratchFolder folder;
    for (const std::string extension : {".msh", ".vtu", ".stl", ".obj", ".ply", ".off", ".vtp"}) {
        const auto pipe = folder / ("pipe" + extension), zero = folder / ("zero" + extension);
        REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
        std::filesystem::create_symlink("/dev/zero", zero);
        std::filesystem::create_directory(folder / ("folder" + extension));
        CHECK_THAT(complaint_about(pipe), Contains("pipe" + extension + ": is a pipe, a file is needed."));
        CHECK_THAT(complaint_about(zero), Contains("zero" + extension + ": is a device, a file is needed."));
        CHECK_THAT(complaint_about(folder / ("folder" + extension)), Contains(": is a folder, a file is needed."));
    }
}

TEST_CASE("files of other programs are refused with the command that converts them", "[mesh][files]") {
    const std::string with_groups =
        "python3 -c 'import sys, meshio; from abut import solid; "
        "solid.mesh(meshio.read(sys.argv[1])).write_vtu(sys.argv[2])' ";
    CHECK_THROWS_WITH(read_mesh<3>("part.inp"),
                      "part.inp: the extension '.inp' is that of an input file of Abaqus, which is not "
                      "read. Convert it with its groups (package python3-meshio): " +
                          with_groups + "part.inp part.vtu");
    for (const std::string part : {"part.vtk", "part.MED", "part.bdf", "part.mesh", "part.su2", "part.exo"})
        CHECK_THROWS_WITH(read_mesh<3>(part), Contains(with_groups + part + " part.vtu"));
    CHECK_THROWS_WITH(read_mesh<3>("part.unv"), Contains("Convert it: gmsh part.unv -save -o part.msh"));
    CHECK_THROWS_WITH(read_mesh<3>("part.key"), Contains("No converter is known. Write the mesh as .unv, .inp or .bdf"));
    CHECK_THROWS_WITH(read_mesh<2>("part.geo"), Contains("Convert it: gmsh part.geo -3 -o part.msh"));
    CHECK_THROWS_WITH(read_mesh<3>("part.step"),
                      Contains("gmsh part.step -setstring Geometry.OCCTargetUnit M -3 -o part.msh"));
    CHECK_THROWS_WITH(read_surface("part.vtk"), Contains("Convert it: meshio convert part.vtk part.vtu"));
}
