#include "mesh/laws.hpp"

using namespace abut;
using namespace abut::mesh;

namespace {

template <int Dim>
double mean_index_distance(const Mesh<Dim>& mesh) {
    double sum = 0.0;
    std::size_t n = 0;
    for (const auto& [first, second] : mesh.face_cells)
        if (second >= 0) {
            sum += second - first;
            ++n;
        }
    return sum / static_cast<double>(n);
}

template <int Dim>
CellSoup<Dim> shuffled(CellSoup<Dim> soup) {
    std::vector<std::int32_t> order(soup.cell_shape.size());
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 random(1);
    for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
    Rows rows;
    for (const std::int32_t cell : order) rows.append(soup.cell_vertices[cell]);
    soup.cell_vertices = rows;
    return soup;
}

}  // namespace

TEST_CASE("reordering keeps the geometry and brings neighbours together", "[mesh][order]") {
    const auto soup = shuffled(test::soup_of(structured_box<3>({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, CellShape::tetrahedron)));
    const auto scattered = build_mesh(soup, {.reorder = false});
    const auto ordered = build_mesh(soup);
    CHECK(mean_index_distance(ordered) < 0.2 * mean_index_distance(scattered));
    REQUIRE(ordered.n_cells() == scattered.n_cells());
    for (std::int32_t cell = 0; cell < ordered.n_cells(); ++cell) {
        const auto before = static_cast<std::size_t>(ordered.cell_label[static_cast<std::size_t>(cell)]);
        CHECK(ordered.cell_measure[static_cast<std::size_t>(cell)] == scattered.cell_measure[before]);
        CHECK(ordered.cell_centroid[static_cast<std::size_t>(cell)] == scattered.cell_centroid[before]);
    }
    for (std::size_t vertex = 0; vertex < ordered.vertices.size(); ++vertex)
        CHECK(ordered.vertices[vertex] == soup.vertices[static_cast<std::size_t>(ordered.vertex_label[vertex])]);
    for (const auto& group : ordered.groups) CHECK(group.faces.size() == scattered.group(group.name).faces.size());
}

TEST_CASE("cells come body after body, ordered or not", "[mesh][order]") {
    auto soup = test::soup_of(test::small_box(CellShape::triangle));
    const auto n = static_cast<std::int32_t>(soup.vertices.size());
    const auto rows = soup.cell_vertices;
    Rows mixed;
    std::vector<std::int32_t> bodies;
    for (std::int32_t cell = 0; cell < rows.size(); ++cell)
        for (const std::int32_t body : {1, 0}) {
            std::vector<std::int32_t> vertices(rows[cell].begin(), rows[cell].end());
            for (auto& vertex : vertices) vertex += body * n;
            mixed.append(vertices);
            bodies.push_back(body);
        }
    const auto copy = soup.vertices;
    for (const auto& vertex : copy) soup.vertices.push_back(vertex + Vector<2>(5, 0));
    soup.cell_vertices = mixed;
    soup.cell_shape.assign(bodies.size(), CellShape::triangle);
    soup.cell_body = bodies;
    soup.body_names = {"near", "far"};
    for (const bool reorder : {true, false}) {
        const auto mesh = build_mesh(soup, {.reorder = reorder});
        CHECK(std::is_sorted(mesh.cell_body.begin(), mesh.cell_body.end()));
        test::check_two_sides(mesh);
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
            CHECK((mesh.cell_centroid[static_cast<std::size_t>(cell)].x() > 4.0) ==
                  (mesh.cell_body[static_cast<std::size_t>(cell)] == 1));
    }
}

TEST_CASE("the same input gives the same bits", "[mesh][order]") {
    const auto soup = shuffled(test::soup_of(test::small_box_3d(CellShape::prism)));
    CHECK(test::same_bits(build_mesh(soup), build_mesh(soup)));
    CHECK(test::same_bits(disc({.size = 0.1, .variant = 1}), disc({.size = 0.1, .variant = 1})));
    CHECK(test::same_bits(cylinder({.size = 0.25}), cylinder({.size = 0.25})));
    const SphereOptions refined{.size = 0.2, .refinement = Refinement<3>{{0, 0, 1}, 0.03, 0.5}, .variant = 2};
    CHECK(test::same_bits(sphere(refined), sphere(refined)));
}
