#include "mesh/laws.hpp"

using namespace abut;
using namespace abut::mesh;

TEST_CASE("a combined mesh holds its parts unchanged, one after another", "[mesh][combine]") {
    const std::vector<Mesh<3>> parts = {test::small_box_3d(CellShape::hexahedron), cylinder({.centre = {9, 0, 0}, .size = 0.4}),
                                        test::small_box_3d(CellShape::prism, {}, {0, 5, 0})};
    const auto all = combine<3>(parts);
    test::check_two_sides(all);
    test::check_closed_cells(all);
    CHECK(all.n_bodies() == 3);
    CHECK(test::total_measure(all) == Approx(test::total_measure(parts[0]) + test::total_measure(parts[1]) + test::total_measure(parts[2])));
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
    const std::vector<Mesh<2>> named = {disc({.size = 0.4, .name = "a"}), disc({.centre = {0, 2}, .size = 0.4, .name = "b"})};
    const auto different = combine<2>(named);
    CHECK(different.body_names == std::vector<std::string>{"a", "b"});
    CHECK(different.groups[1].name == "b.boundary");
}

TEST_CASE("nothing combined is an empty mesh", "[mesh][combine]") { CHECK(combine<2>({}).n_cells() == 0); }
