#include "mesh/laws.hpp"

using namespace abut;
using namespace abut::mesh;

TEST_CASE("a combined mesh holds its parts unchanged, one after another", "[mesh][combine]") {
    const std::vector<Mesh<3>> parts = {test::small_box_3d(CellShape::hexahedron),
                                        cylinder({.centre = {9, 0, 0}, .size = 0.4}),
                                        test::small_box_3d(CellShape::prism, {}, {0, 5, 0})};
    const auto all = combine<3>(parts);
    test::check_two_sides(all);
    test::check_closed_cells(all);
    CHECK(all.n_bodies() == 3);
    CHECK(test::total_measure(all) ==
          Approx(test::total_measure(parts[0]) + test::total_measure(parts[1]) + test::total_measure(parts[2])));
    CHECK(std::is_sorted(all.cell_body.begin(), all.cell_body.end()));
    CHECK(all.cell_body.back() == 2);
    const auto first = static_cast<std::size_t>(parts[0].n_cells());
    CHECK(all.cell_centroid[first] == parts[1].cell_centroid[0]);
    const auto face = all.group("side").faces.front();
    CHECK(all.cell_body[static_cast<std::size_t>(all.face_cells[static_cast<std::size_t>(face)][0])] == 1);
    CHECK(all.name == "box+cylinder+box");
}

TEST_CASE("clashing names of bodies and groups get the name of their mesh in front", "[mesh][combine]") {
    const std::vector<Mesh<2>> two = {disc({.size = 0.4}), disc({.centre = {0, 2}, .size = 0.4, .variant = 1})};
    const auto same = combine<2>(two);
    CHECK(same.body_names == std::vector<std::string>{"disc_1.disc", "disc_2.disc"});
    CHECK(same.groups[0].name == "disc_1.boundary");
    CHECK(same.group("disc_2.boundary").faces.size() == two[1].groups[0].faces.size());
    const std::vector<Mesh<2>> named = {disc({.size = 0.4, .name = "a"}),
                                        disc({.centre = {0, 2}, .size = 0.4, .name = "b"})};
    const auto different = combine<2>(named);
    CHECK(different.body_names == std::vector<std::string>{"a", "b"});
    CHECK(different.groups[1].name == "b.boundary");
}

TEST_CASE("vertices of two bodies at one place are counted", "[mesh][combine]") {
    const auto coincident = [](const Vector<2>& at, int n) {
        const std::vector<Mesh<2>> two = {structured_box<2>({0, 0}, {1, 1}, {4, 4}, CellShape::triangle, "low"),
                                          structured_box<2>(at, at + Vector<2>(1, 1), {n, n}, CellShape::triangle, "high")};
        return combine<2>(two).report.n_coincident_vertices;
    };
    CHECK(coincident({0, 1}, 4) == 2 * 5);         // node on node along the whole side
    CHECK(coincident({0, 1 + 1e-9}, 4) == 2 * 5);  // apart by less than 1e-6 of a face
    CHECK(coincident({0, 1}, 3) == 2 * 2);         // the corners only
    CHECK(coincident({0, 1.01}, 4) == 0);
    CHECK(coincident({0.1, 1}, 4) == 0);
    CHECK(test::small_box(CellShape::triangle).report.n_coincident_vertices == 0);
}

TEST_CASE("names that clash even with their meshes in front are refused", "[mesh][combine]") {
    auto named = [](const std::string& mesh_name, const std::string& body, double at) {
        auto soup = test::soup_of(structured_box<2>({at, 0}, {at + 1, 1}, {1, 1}, CellShape::triangle, mesh_name));
        soup.body_names = {body};
        soup.named_faces.clear();
        soup.group_names.clear();
        return build_mesh(soup);
    };
    const std::vector<Mesh<2>> three = {named("a", "x", 0), named("b", "x", 2), named("c", "a.x", 4)};
    CHECK_THROWS_WITH(combine<2>(three), Catch::Contains("a+b+c: 2 bodies are called 'a.x', each needs a name of its own."));
}

TEST_CASE("nothing combined is an empty mesh", "[mesh][combine]") { CHECK(combine<2>({}).n_cells() == 0); }
