// Bodies that turn, in a finite element code with finite strains: two gears on axles, and a block that tumbles on a plane.
//
// Triangles of St. Venant and Kirchhoff's material, whose mean force over a step, F_mid S_mean, is exact for energy. The
// first gear spins at 0.1 rad/s and drives the second, as large, which is at rest at first: without friction and losses each
// has half of the angular momentum in the end, on average, and their teeth never pass each other. The block falls on its
// corner and spins. H~ is kept to round-off in both, however far the bodies turn.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/nodal_faces.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/mesh/shapes/shapes.hpp"

using namespace abut;

constexpr double lambda = 0.3 / (1.3 * 0.4), mu = 0.5 / 1.3;  // E = 1, nu = 0.3 [Pa]; rho = 1
using V = Vector<2>;
using M = Matrix<2>;

struct Scene {
    mesh::Mesh<2> mesh;
    contact::RigidObstacle<2> obstacle = {};
    double axle = 0.0;   ///< stiffness of a spring that holds the mean of the nodes of each body [N/m]; 0: none
    V gravity = {0, 0};  ///< [m/s^2]
};

M second_piola(const M& g) {  // from the displacement gradient
    const M strain = 0.5 * (g + g.transpose() + g.transpose() * g);
    return lambda * strain.trace() * M::Identity() + 2.0 * mu * strain;
}

class Bodies {
public:
    explicit Bodies(Scene given)
        : scene(std::move(given)), mass(scene.mesh.vertices.size(), 0.0), body(mass.size()), contact(skin()) {
        for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c) {
            const auto node = scene.mesh.cell_vertices[c];
            const std::vector<V>& x = scene.mesh.vertices;
            const M edges = M::from_columns(x[node[1]] - x[node[0]], x[node[2]] - x[node[0]]), of_others = edges.inverse();
            slopes_.push_back(SmallMatrix<2, 3>::from_columns(-(of_others.transpose() * V::Ones()),
                                                              of_others.row(0).transpose(), of_others.row(1).transpose()));
            for (const std::int32_t n : node) mass[n] += scene.mesh.cell_measure[c] / 3, body[n] = scene.mesh.cell_body[c];
        }
        for (const double m : mass) inverse_mass_.insert(inverse_mass_.end(), 2, 1.0 / m);
        body_mass_ = {0.0, 0.0};
        for (std::size_t i = 0; i < mass.size(); ++i) body_mass_[body[i]] += mass[i];
    }
    std::size_t size() const { return inverse_mass_.size(); }
    std::span<const double> inverse_mass() const { return inverse_mass_; }

    double potential(std::span<const double> q) {
        double energy = contact.evaluate(placed(q)).energy;
        for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c) {
            const M g = gradient(c, q), strain = 0.5 * (g + g.transpose() + g.transpose() * g);
            energy += 0.5 * scene.mesh.cell_measure[c] * second_piola(g).cwiseProduct(strain).sum();
        }
        for (std::size_t i = 0; i < mass.size(); ++i) energy -= mass[i] * scene.gravity.dot(as_vectors<2>(q)[i]);
        for (int b = 0; b < 2; ++b) energy += 0.5 * scene.axle * mean(b, q).squaredNorm();
        return energy;
    }
    void force(std::span<const double> q, std::span<double> f) { add(q, q, contact.evaluate(placed(q)), f); }
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double dt, std::span<double> f) {
        add(q_0, q_1, contact.step(dt, placed(q_0), placed(q_1)), f);
    }
    /// sum (x - c) x p of a body about its centre at rest.
    double spin(int b, const V& centre, std::span<const double> q, std::span<const double> p) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < mass.size(); ++i)
            if (body[i] == b)
                sum += moment<2>(scene.mesh.vertices[i] + as_vectors<2>(q)[i] - centre, as_vectors<2>(p)[i])[0];
        return sum;
    }

    const Scene scene;
    std::vector<double> mass;
    std::vector<std::int32_t> body;
    std::vector<V> nodes;  ///< at rest, those of the obstacle at the end
    contact::NodalContact<2> contact;

private:
    contact::NodalSurface<2> skin() {
        contact::NodalFaceArrays<2> faces;
        nodes = scene.mesh.vertices;
        for (const std::int32_t face : scene.mesh.boundary_faces) {
            const std::int32_t cell = scene.mesh.face_cells[face][0];
            faces.append_face(scene.mesh.face_vertices[face], scene.mesh.cell_measure[cell] / scene.mesh.face_measure[face],
                              scene.mesh.cell_body[cell]);
        }
        faces.stiffness.assign(scene.mesh.n_bodies(), contact::skin_stiffness(lambda + 2.0 * mu, faces.depth));
        if (!scene.obstacle.faces.empty()) faces.append_obstacle(scene.obstacle, nodes);
        return {nodes, faces.view()};
    }
    std::vector<V> placed(std::span<const double> q) const {
        std::vector<V> x = nodes;
        for (std::size_t i = 0; i < mass.size(); ++i) x[i] += as_vectors<2>(q)[i];
        return x;
    }
    M gradient(std::int32_t cell, std::span<const double> q) const {
        M g = M::Zero();
        for (int i = 0; i < 3; ++i)
            g += as_vectors<2>(q)[scene.mesh.cell_vertices[cell][i]] * slopes_[cell].col(i).transpose();
        return g;
    }
    V mean(int b, std::span<const double> q) const {
        V sum = V::Zero();
        for (std::size_t i = 0; i < mass.size(); ++i)
            if (body[i] == b) sum += mass[i] / body_mass_[b] * as_vectors<2>(q)[i];
        return sum;
    }
    void add(std::span<const double> q_0, std::span<const double> q_1, const contact::NodalStep<2>& step,
             std::span<double> f) const {
        const auto force = as_vectors<2>(f);
        std::array<V, 2> pull;
        for (int b = 0; b < 2; ++b) pull[b] = -0.5 * scene.axle * (mean(b, q_0) + mean(b, q_1));
        for (std::size_t i = 0; i < mass.size(); ++i)
            force[i] = mass[i] * scene.gravity + mass[i] / body_mass_[body[i]] * pull[body[i]];
        for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c) {
            const M g_0 = gradient(c, q_0), g_1 = gradient(c, q_1), middle = M::Identity() + 0.5 * (g_0 + g_1);
            const M stress = 0.5 * scene.mesh.cell_measure[c] * middle * (second_piola(g_0) + second_piola(g_1));
            for (int i = 0; i < 3; ++i) force[scene.mesh.cell_vertices[c][i]] -= stress * slopes_[c].col(i);
        }
        step.add_force_to(f);  // nodes of the obstacle come last, and get none
    }

    std::vector<SmallMatrix<2, 3>> slopes_;
    std::array<double, 2> body_mass_;
    std::vector<double> inverse_mass_;
};

mesh::Mesh<2> gear(double x, double phase) {  // 12 round teeth about r = 1, on a bore of 0.4
    constexpr int n = 144, layers = 6;
    mesh::CellSoup<2> soup{.name = "gear", .body_names = {"gear"}};
    for (int j = 0; j <= layers; ++j)
        for (int i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / n, outer = 1.0 + 0.11 * std::cos(12.0 * (angle - phase));
            const double r = 0.4 + (outer - 0.4) * j / layers;
            soup.vertices.emplace_back(x + r * std::cos(angle), r * std::sin(angle));
            if (j == layers) continue;
            const int a = j * n + i, b = j * n + (i + 1) % n;
            for (const auto& triangle : {std::array{a, a + n, b + n}, std::array{a, b + n, b}}) {
                soup.cell_vertices.append(triangle);
                soup.cell_shape.push_back(mesh::CellShape::triangle);
                soup.cell_body.push_back(0);
            }
        }
    return mesh::build_mesh<2>(std::move(soup));
}

/// Runs with body 0 spinning about its centre. Whether H~ stays, bodies touch and none is missed, and gears share their
/// spin.
bool run(const char* name, Bodies& bodies, double spin, const V& centre, double time, double dt) {
    std::vector<double> p(bodies.size(), 0.0);
    for (std::size_t i = 0; i < bodies.mass.size(); ++i) {
        const V arm = bodies.scene.mesh.vertices[i] - centre;
        if (bodies.body[i] == 0) as_vectors<2>(std::span(p))[i] = spin * bodies.mass[i] * V(-arm[1], arm[0]);
    }
    dynamics::Memm<Bodies> memm(bodies, std::vector<double>(bodies.size(), 0.0), p, dt);
    const double start = memm.pseudo_energy();
    double drift = 0.0, largest = memm.kinetic_energy(), other = 0.0;
    while (memm.time() < time) {
        memm.step();
        if (memm.steps() % 50 == 0) {
            drift = std::max(drift, std::abs(memm.pseudo_energy() - start));
            largest = std::max(largest, memm.kinetic_energy());
        }
        if (memm.time() > 0.5 * time) other += bodies.spin(1, V(2.06, 0.0), memm.q(), memm.p_after()) * dt / (0.5 * time);
    }
    const auto& report = bodies.contact.report();
    std::printf(
        "%-13s %6lld steps, H~ drifts by %.1e, corrections up to %.0e of the forces, |g|/D up to %.2f, %lld missed\n", name,
        static_cast<long long>(memm.steps()), drift / largest, report.correction_max, report.compression_max,
        static_cast<long long>(report.missed_contacts));
    const bool holds = drift < 1e-12 * largest && report.missed_contacts == 0 && report.active_pairs_max > 0;
    if (bodies.scene.axle == 0.0) return holds;
    const double share = -other / bodies.spin(0, centre, std::vector<double>(bodies.size(), 0.0), p);
    std::printf("              the second gear has %.3f of the angular momentum of the first at the start, exact 0.5\n",
                share);
    return holds && std::abs(share - 0.5) < 0.05;
}

int main() {
    Bodies gears({.mesh = mesh::combine<2>(std::vector{gear(0.0, 0.0), gear(2.06, std::numbers::pi / 12.0)}), .axle = 10.0});
    Bodies block({.mesh = mesh::structured_box<2>({-0.5, 0.9}, {0.5, 1.4}, {10, 5}, mesh::CellShape::triangle),
                  .obstacle = contact::plane_obstacle<2>({0.0, 0.0}, {0.0, 1.0}, 20.0),
                  .gravity = {0.0, -0.002}});
    const bool gears_hold = run("two gears", gears, 0.1, {0.0, 0.0}, 120.0, 0.012);
    const bool block_holds = run("tumbling block", block, 0.05, {0.0, 1.15}, 100.0, 0.02);
    return gears_hold && block_holds ? 0 : 1;
}
