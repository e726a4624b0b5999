// Contact in a finite element code: two elastic bodies of linear elements run into each other off centre.
//
// Discs of triangles (cylinders of tetrahedra with the argument 3), R = E = rho = 1, nu = 0.3, at +-0.05 along x, centres
// 0.8 apart along y; small strains. Contact takes the nodes at both ends of a step and gives forces on them. Other codes of
// this kind find that the left body leaves at (-0.0279, -0.0400), in 3D at (-0.0276, -0.0403). MEMM keeps H~ to round-off.
// A second argument is a coefficient of friction, up to 0.08, so that the bodies slide all along: H~, with what faces hold that
// stick, then falls by what friction takes, and that is what rigid discs lose, to 5 %.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/dynamics/highest_mode.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/mesh/shapes/shapes.hpp"

using namespace abut;

constexpr double lambda = 0.3 / (1.3 * 0.4), mu = 0.5 / 1.3;  // [Pa]

template <int Dim>
class FiniteElements {  // q: displacements of the nodes, (n_nodes, Dim)
public:
    static constexpr int dimension = Dim;
    FiniteElements(const mesh::Mesh<Dim>& bodies, double friction)
        : mesh(bodies), contact(skin(mesh), options(friction)), mass_(mesh.vertices.size(), 0.0) {
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const auto node = mesh.cell_vertices[c];
            Matrix<Dim> edges;  // from the first node: the rows of the inverse are the slopes of the others' shape functions
            for (int i = 0; i < Dim; ++i) edges.col(i) = mesh.vertices[node[i + 1]] - mesh.vertices[node[0]];
            const Matrix<Dim> of_others = edges.inverse();
            auto& slopes = slopes_.emplace_back();
            slopes.col(0) = -(of_others.transpose() * Vector<Dim>::Ones());
            for (int i = 0; i < Dim; ++i) slopes.col(i + 1) = of_others.row(i).transpose();
            for (const std::int32_t n : node) mass_[n] += mesh.cell_measure[c] / (Dim + 1);
        }
        for (const double m : mass_) inverse_mass_.insert(inverse_mass_.end(), Dim, 1.0 / m);
    }
    std::size_t size() const { return inverse_mass_.size(); }
    std::span<const double> inverse_mass() const { return inverse_mass_; }
    std::span<const double> masses() const { return mass_; }
    std::span<const Vector<Dim>> rest_positions() const { return mesh.vertices; }
    double work() const { return 0.0; }
    bool is_autonomous() const { return true; }

    void stiffness_product(std::span<const double> q, std::span<double> product) const {
        std::ranges::fill(product, 0.0);
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const auto node = mesh.cell_vertices[c];
            Matrix<Dim> g = Matrix<Dim>::Zero();  // du/dx
            for (int i = 0; i <= Dim; ++i) g += as_vectors<Dim>(q)[node[i]] * slopes_[c].col(i).transpose();
            const Matrix<Dim> stress = lambda * g.trace() * Matrix<Dim>::Identity() + mu * (g + g.transpose());
            for (int i = 0; i <= Dim; ++i)
                as_vectors<Dim>(product)[node[i]] += mesh.cell_measure[c] * stress * slopes_[c].col(i);
        }
    }
    double potential(std::span<const double> q) {
        std::vector<double> product(size());
        stiffness_product(q, product);
        for (std::size_t i = 0; i < size(); ++i) product[i] *= 0.5 * q[i];
        const contact::NodalStep<Dim>& now = contact.evaluate(placed(q));
        return std::reduce(product.begin(), product.end()) + now.energy + now.report.friction.energy;
    }
    dynamics::ContactCounts contact_counts() const {  // for the ledger
        const contact::ContactReport& report = contact.report();
        return {.active_pairs = report.active_pairs,
                .events = report.events,
                .dissipated = report.friction_dissipated,
                .friction_energy = contact.last().report.friction.energy,
                .sticking_faces = report.sticking_faces,
                .sliding_faces = report.sliding_faces};
    }
    void force(std::span<const double> q, std::span<double> f) { add(q, q, contact.evaluate(placed(q)), f); }
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double dt, std::span<double> f) {
        add(q_0, q_1, contact.step(dt, placed(q_0), placed(q_1), contact::TakenForce::mean), f);
    }
    void end_force(std::span<const double> q_0, std::span<const double> q_1, double, double dt, std::span<double> f) {
        add(q_1, q_1, contact.step(dt, placed(q_0), placed(q_1), contact::TakenForce::end), f);
    }

    const mesh::Mesh<Dim> mesh;
    contact::NodalContact<Dim> contact;

private:
    static contact::NodalSurface<Dim> skin(const mesh::Mesh<Dim>& mesh) {
        std::vector<std::int32_t> nodes, body;
        std::vector<double> depth;  // half the height of the element behind a face
        for (const std::int32_t face : mesh.boundary_faces) {
            const std::int32_t cell = mesh.face_cells[face][0];
            nodes.insert(nodes.end(), mesh.face_vertices[face].begin(), mesh.face_vertices[face].end());
            body.push_back(mesh.cell_body[cell]);
            depth.push_back(0.5 * Dim * mesh.cell_measure[cell] / mesh.face_measure[face]);
        }
        const std::vector<double> stiffness(2, contact::skin_stiffness(lambda + 2.0 * mu, depth));
        const std::vector<double> shear_stiffness(2, mu / (lambda + 2.0 * mu) * stiffness[0]);  // for friction alone
        return {mesh.vertices,
                {.nodes = nodes,
                 .offsets = {},
                 .body = body,
                 .depth = depth,
                 .stiffness = stiffness,
                 .shear_stiffness = shear_stiffness}};
    }
    static contact::NodalOptions options(double friction) {
        contact::NodalOptions options;
        if (friction > 0.0) options.friction.laws = {{.coefficient = friction}};
        return options;
    }
    std::vector<Vector<Dim>> placed(std::span<const double> q) const {
        std::vector<Vector<Dim>> x = mesh.vertices;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += as_vectors<Dim>(q)[i];
        return x;
    }
    void add(std::span<const double> q_0, std::span<const double> q_1, const contact::NodalStep<Dim>& step,
             std::span<double> f) {
        std::vector<double> middle(size());
        for (std::size_t i = 0; i < size(); ++i) middle[i] = -0.5 * (q_0[i] + q_1[i]);
        stiffness_product(middle, f);
        step.add_force_to(f);
    }

    std::vector<double> mass_, inverse_mass_;
    std::vector<SmallMatrix<Dim, Dim + 1>> slopes_;  // of the shape functions
};

/// What friction takes from rigid discs that slide all along the impact, over K0: they meet with the normal impulse of discs
/// without friction, and each kg m/s along their faces changes the speed of sliding by 3/m on each disc.
template <int Dim>
double taken_by_sliding(const Vector<Dim>& without_friction, double friction) {
    const Vector<Dim> start = 0.05 * Vector<Dim>::Unit(0);
    const double impulse = (without_friction - start).norm();  // over m [m/s]
    const double sliding = 0.1 * std::abs(without_friction[1]) / impulse;
    return friction * impulse * (sliding - 3.0 * friction * impulse) / (2.0 * 0.5 * 0.05 * 0.05);
}

template <template <class> class Scheme, int Dim>
bool run(const char* name, double allowed_drift, const mesh::Mesh<Dim>& mesh, const Vector<Dim>& expected, double friction) {
    FiniteElements<Dim> host(mesh, friction);
    const auto is_left = [&](std::size_t i) { return mesh.vertices[i].template head<2>().norm() < 1.001; };
    std::vector<double> p(host.size(), 0.0), mass(host.masses().begin(), host.masses().end());
    for (std::size_t i = 0; i < mass.size(); ++i) p[Dim * i] = mass[i] * (is_left(i) ? 0.05 : -0.05);
    const double dt = host.contact.stable_step(mass, dynamics::bound_of(dynamics::highest_mode(host))).dt;
    Scheme<FiniteElements<Dim>> scheme(host, std::vector<double>(host.size(), 0.0), p, dt);
    dynamics::Ledger<Dim> ledger;
    for (ledger.record(measure(scheme, host)); scheme.time() < 15.0; ledger.record(measure(scheme, host))) scheme.step();

    Vector<Dim> momentum = Vector<Dim>::Zero();
    double left_mass = 0.0;
    for (std::size_t i = 0; i < mass.size(); ++i)
        if (is_left(i)) momentum += dynamics::RunView<Dim>(scheme).momentum(i), left_mass += mass[i];
    const double drift = ledger.pseudo_energy_drift() / ledger.entries()[0].kinetic;
    std::printf("%-20s left body: (%.4f, %.4f); H~ drifts by %.1e K0, momentum by %.1e kg m/s\n", name,
                momentum[0] / left_mass, momentum[1] / left_mass, drift, ledger.momentum_drift());
    const bool is_kept = drift < allowed_drift && ledger.momentum_drift() < 1e-13;
    if (friction == 0.0) return is_kept && (momentum / left_mass - expected).norm() < 1e-3;
    const contact::ContactReport& report = host.contact.report();
    const double taken = report.friction_dissipated / ledger.entries()[0].kinetic;
    const double of_rigid = taken_by_sliding<Dim>(expected, friction);
    std::printf("%20s friction takes %.4f K0, from rigid discs %.4f; its force is up to %.6f of the limit\n", "", taken,
                of_rigid, report.friction_ratio_max);
    return is_kept && std::abs(taken - of_rigid) < 0.05 * of_rigid && report.friction_ratio_max < 1.0 + 1e-12;
}

template <int Dim>
bool run_both(const mesh::Mesh<Dim>& left, const mesh::Mesh<Dim>& right, const Vector<Dim>& expected, double friction) {
    const mesh::Mesh<Dim> mesh = mesh::combine<Dim>(std::vector{left, right});
    return run<dynamics::Memm, Dim>("MEMM", 1e-13, mesh, expected, friction) &&
           run<dynamics::Leapfrog, Dim>("central differences", 1e-2, mesh, expected, friction);
}

int main(int argc, char** argv) {
    const double along = std::sqrt(2.02 * 2.02 - 0.8 * 0.8);
    const auto disc = [](double x, double y, int i) { return mesh::disc({.centre = {x, y}, .size = 0.08, .variant = i}); };
    const auto rod = [](double x, double y, int i) {
        return mesh::cylinder({.centre = {x, y, 0}, .size = 0.2, .variant = i});
    };
    const double friction = argc > 2 ? std::atof(argv[2]) : 0.0;
    if (argc > 1 && argv[1][0] == '3')
        return run_both<3>(rod(0, 0, 0), rod(along, 0.8, 1), {-0.0276, -0.0403, 0.0}, friction) ? 0 : 1;
    return run_both<2>(disc(0, 0, 0), disc(along, 0.8, 1), {-0.0279, -0.0400}, friction) ? 0 : 1;
}
