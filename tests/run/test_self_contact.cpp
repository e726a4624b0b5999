// Bodies that turn and bend, and touch themselves: the two arms of a C that fly towards each other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/cell_view.hpp"

using namespace abut;

namespace {

constexpr double width = 0.1, slot = 0.03, length = 0.8;  // of an arm, and between them [m]
constexpr double cell = 0.05;                             // along y; 0.05 along x
constexpr int n_columns = 16;

/// Cells of the C, by their column, row and layer; those of the slot are left out, but for the first two columns.
template <int Dim>
run::Scene<Dim> clapping_c(double speed, solid::Kinematics kinematics) {
    const int n = n_columns, layers = Dim == 2 ? 0 : 2;
    const std::vector<double> y{0.0, 0.5 * width, width, width + slot, 1.5 * width + slot, 2.0 * width + slot};
    mesh::CellSoup<Dim> soup;
    soup.name = "c";
    soup.body_names = {"c"};
    const auto n_rows = static_cast<int>(y.size());
    for (int layer = 0; layer <= layers; ++layer)
        for (const double of_row : y)
            for (int i = 0; i <= n; ++i) {
                Vector<Dim> x = Vector<Dim>::Constant(0.06 * layer);
                x[0] = length * i / n, x[1] = of_row;
                soup.vertices.push_back(x);
            }
    for (int layer = 0; layer < std::max(layers, 1); ++layer)
        for (int row = 0; row + 1 < n_rows; ++row)
            for (int i = 0; i < n; ++i) {
                if (row == 2 && i > 1) continue;
                const int a = (layer * n_rows + row) * (n + 1) + i, above = n_rows * (n + 1);
                std::vector<std::int32_t> corners{a, a + 1, a + n + 2, a + n + 1};
                const auto append = [&](const std::vector<std::int32_t>& of_cell) {
                    soup.cell_vertices.append(of_cell);
                    soup.cell_shape.push_back(Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::tetrahedron);
                    soup.cell_body.push_back(0);
                };
                if constexpr (Dim == 2) append(corners);
                if constexpr (Dim == 3) {  // six around the diagonal of a brick
                    for (int k = 0; k < 4; ++k) corners.push_back(corners[static_cast<std::size_t>(k)] + above);
                    for (const auto& [b, c] : {std::pair{1, 2}, {5, 1}, {2, 3}, {3, 7}, {4, 5}, {7, 4}})
                        append({corners[0], corners[static_cast<std::size_t>(b)], corners[static_cast<std::size_t>(c)],
                                corners[6]});
                }
            }
    run::Scene<Dim> scene;
    scene.mesh = mesh::build_mesh<Dim>(std::move(soup));
    scene.solid.materials = {{.young = 4e4, .poisson = 0.3, .density = 1000.0}};
    scene.solid.kinematics = {kinematics};
    scene.velocity = {0.2 * speed * Vector<Dim>::Unit(0)};
    scene.spin = {AxialVector<Dim>::Constant(0.1)};
    scene.added_velocity = [=](const Vector<Dim>& x) {
        const double of_length = std::max(0.0, x[0] - 0.1) / length;
        return Vector<Dim>((x[1] < width + 0.5 * slot ? speed : -speed) * of_length * Vector<Dim>::Unit(1));
    };
    scene.time = 0.1 / speed;
    return scene;
}

/// How deep the arms are in each other: of the vertices at the inner side of one arm, those of the other one that are nearest
/// along the C are no farther than this on the wrong side [m].
template <int Dim>
class Depth : public run::Observer<Dim> {
public:
    explicit Depth(const mesh::Mesh<Dim>& mesh) : mesh_(mesh) {}
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        const std::vector<Vector<Dim>> u = solid.cells().vertex_displacement(run.q);
        const auto moved = [&](std::size_t v) { return Vector<Dim>(mesh_.vertices[v] + u[v]); };
        const auto at = [&](const Vector<Dim>& rest) {
            return static_cast<std::size_t>(
                std::ranges::find_if(mesh_.vertices, [&](const Vector<Dim>& x) { return (x - rest).norm() < 1e-9; }) -
                mesh_.vertices.begin());
        };
        for (std::size_t a = 0; a < u.size(); ++a) {
            const Vector<Dim>& rest = mesh_.vertices[a];
            if (std::abs(rest[1] - width) > 1e-9 || rest[0] < 0.15) continue;
            // Along the normal of the lower arm, which is that of its edge to the vertex before.
            const Vector<Dim> along = moved(a) - moved(at(rest - length / n_columns * Vector<Dim>::Unit(0)));
            Vector<Dim> normal = Vector<Dim>::Zero();
            normal[0] = -along[1], normal[1] = along[0];
            const double gap = (moved(at(rest + slot * Vector<Dim>::Unit(1))) - moved(a)).dot(normal.normalized());
            deepest = std::max(deepest, -gap);
        }
    }
    double deepest = -std::numeric_limits<double>::infinity();

private:
    const mesh::Mesh<Dim>& mesh_;
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("a C that claps its ends keeps pseudo-energy and momenta, and its arms do not enter each other",
                       "[run][self]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(solid::Kinematics::finite, solid::Kinematics::floating);
    const auto scene = clapping_c<Dim>(0.5, kinematics);
    run::RunOptions options{.interval = 1};
    for (const bool touches : {false, true}) {
        if (!touches && kinematics == solid::Kinematics::finite) continue;  // arms that pass through each other fold
        options.contact.search.self_contact = touches;
        Depth<Dim> depth(scene.mesh);
        if (!touches) {
            try {  // fast arms may be through each other between two looks
                static_cast<void>(run::simulate<Dim>(scene, options, depth));
            } catch (const Diverged& error) {
                CHECK_THAT(error.what(), Catch::Contains("goes through itself"));
            }
            CHECK(depth.deepest > 0.3 * cell);
            continue;
        }
        const auto result = run::simulate<Dim>(scene, options, depth);
        CAPTURE(depth.deepest);
        CHECK(result.contact.report.active_pairs_max > 0);
        CHECK(depth.deepest <= 0.3 * cell);
        CHECK(result.contact.report.missed_contacts == 0);
        CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.ledger.largest_energy());
        const double momentum = scene.solid.materials[0].density * 0.16;  // of the whole at 1 m/s, at most
        CHECK(result.ledger.momentum_drift() < 1e-13 * momentum);
        CHECK(result.ledger.pseudo_angular_momentum_drift() < 1e-13 * momentum);
        CHECK(result.watch.sightings.near_themselves.empty());
    }
}

TEST_CASE("a cube that flies and turns has no pair of itself in the list: to touch itself costs nothing", "[run][self]") {
    run::Scene<3> scene;
    scene.mesh = mesh::structured_box<3>(Vector<3>::Zero(), Vector<3>::Ones(), {6, 6, 6}, mesh::CellShape::tetrahedron);
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.solid.kinematics = {GENERATE(solid::Kinematics::finite, solid::Kinematics::floating)};
    scene.velocity = {Vector<3>(0.1, 0.0, 0.0)};  // a tenth of the speed of waves
    scene.added_velocity = [](const Vector<3>& x) { return Vector<3>(-0.02 * (x.y() - 0.5), 0.02 * (x.x() - 0.5), 0.0); };
    scene.time = 4.0;
    run::RunOptions options{.interval = 10};
    options.contact.search.self_contact = true;
    const auto result = run::simulate<3>(scene, options);
    CHECK(result.contact.report.rebuilds > 1);
    CHECK(result.contact.report.candidates == 0);
    CHECK(result.contact.report.missed_contacts == 0);
}
