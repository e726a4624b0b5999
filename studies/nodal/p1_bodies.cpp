#include "studies/nodal/p1_bodies.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "abut/dynamics/highest_mode.hpp"

namespace abut::studies::nodal {
namespace {

template <int Dim>
Matrix<Dim> hooke(double lambda, double mu, const Matrix<Dim>& strain) {
    return lambda * strain.trace() * Matrix<Dim>::Identity() + 2.0 * mu * strain;
}

/// Half the height of the element behind a boundary face.
template <int Dim>
double half_height(const mesh::Mesh<Dim>& mesh, std::int32_t face) {
    return 0.5 * Dim * mesh.cell_measure[mesh.face_cells[face][0]] / mesh.face_measure[face];
}

}  // namespace

template <int Dim>
contact::NodalSurface<Dim> P1Bodies<Dim>::surface_of(const run::Scene<Dim>& scene, const NodalParts<Dim>& parts,
                                                     std::vector<Vector<Dim>>& all_nodes) {
    const mesh::Mesh<Dim>& mesh = scene.mesh;
    all_nodes = mesh.vertices;
    contact::NodalFaceArrays<Dim> faces;
    std::vector<std::vector<double>> depths(scene.solid.materials.size());
    for (const std::int32_t face : mesh.boundary_faces) {
        const std::int32_t body = mesh.cell_body[mesh.face_cells[face][0]];
        const double depth = half_height(mesh, face);
        if (!parts.touches || parts.touches(mesh.face_centroid[face]))
            depths[static_cast<std::size_t>(body)].push_back(depth);
        faces.append_face(mesh.face_vertices[face], depth, body);
    }
    for (std::size_t body = 0; body < depths.size(); ++body)
        faces.stiffness.push_back(contact::skin_stiffness(scene.solid.materials[body].wave_modulus(), depths[body]));
    for (const auto& obstacle : scene.solid.obstacles) faces.append_obstacle(obstacle, all_nodes);
    return contact::NodalSurface<Dim>(all_nodes, faces.view());
}

template <int Dim>
P1Bodies<Dim>::P1Bodies(run::Scene<Dim> scene, NodalParts<Dim> parts, const geometry::FacingFade& facing)
    : scene_(std::move(scene)),
      parts_(std::move(parts)),
      is_finite_(!scene_.solid.kinematics.empty() && scene_.solid.kinematics.front() == Kinematics::finite),
      contact_(surface_of(scene_, parts_, rest_), {.facing = facing}),
      x_0_(rest_),
      x_1_(rest_) {
    if (scene_.solid.acceleration.empty())
        scene_.solid.acceleration.assign(scene_.solid.materials.size(), Vector<Dim>::Zero());
    make_elements();
}

template <int Dim>
void P1Bodies<Dim>::make_elements() {
    const mesh::Mesh<Dim>& mesh = scene_.mesh;
    mass_.assign(mesh.vertices.size(), 0.0);
    node_body_.assign(mesh.vertices.size(), 0);
    node_elements_.resize(mesh.vertices.size());
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const solid::Material& material = scene_.solid.materials[static_cast<std::size_t>(mesh.cell_body[cell])];
        Element element{
            .node = {}, .slope = {}, .measure = mesh.cell_measure[cell], .lambda = material.lambda(), .mu = material.mu()};
        std::ranges::copy(mesh.cell_vertices[cell], element.node.begin());
        Matrix<Dim> edges;
        for (int i = 0; i < Dim; ++i) edges.col(i) = mesh.vertices[element.node[i + 1]] - mesh.vertices[element.node[0]];
        const Matrix<Dim> slopes = edges.inverse();
        element.slope[0] = -(slopes.transpose() * Vector<Dim>::Ones());
        for (int i = 0; i < Dim; ++i) element.slope[i + 1] = slopes.row(i).transpose();
        for (const std::int32_t node : element.node) {
            mass_[node] += material.density * element.measure / (Dim + 1);
            node_body_[node] = mesh.cell_body[cell];
            node_elements_[node].push_back(cell);
        }
        elements_.push_back(element);
    }
    for (const double m : mass_)
        for (int d = 0; d < Dim; ++d) inverse_mass_.push_back(1.0 / m);
}

template <int Dim>
Matrix<Dim> P1Bodies<Dim>::gradient(const Element& element, std::span<const double> q) const {
    const auto u = as_vectors<Dim>(q);
    Matrix<Dim> g = Matrix<Dim>::Zero();
    for (int i = 0; i < Dim + 1; ++i) g += u[element.node[i]] * element.slope[i].transpose();
    return g;
}

/// First Piola-Kirchhoff: sigma of the mean strain, or F_mid S_mean.
template <int Dim>
Matrix<Dim> P1Bodies<Dim>::stress_between(const Element& element, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1) const {
    const Matrix<Dim> g = 0.5 * (g_0 + g_1);
    if (!is_finite_) return hooke<Dim>(element.lambda, element.mu, Matrix<Dim>(0.5 * (g + g.transpose())));
    const auto green = [](const Matrix<Dim>& h) { return Matrix<Dim>(0.5 * (h + h.transpose() + h.transpose() * h)); };
    const Matrix<Dim> strain = 0.5 * (green(g_0) + green(g_1));
    return (Matrix<Dim>::Identity() + g) * hooke<Dim>(element.lambda, element.mu, strain);
}

template <int Dim>
void P1Bodies<Dim>::add_bulk(std::span<const double> q_0, std::span<const double> q_1, std::span<double> f) const {
    const auto force = as_vectors<Dim>(f);
    for (const Element& element : elements_) {
        const Matrix<Dim> stress = element.measure * stress_between(element, gradient(element, q_0), gradient(element, q_1));
        for (int i = 0; i < Dim + 1; ++i) force[element.node[i]] -= stress * element.slope[i];
    }
}

template <int Dim>
void P1Bodies<Dim>::add_outside(std::span<const double> q_0, std::span<const double> q_1, std::span<double> f) const {
    const auto force = as_vectors<Dim>(f);
    for (std::size_t i = 0; i < mass_.size(); ++i) force[i] += mass_[i] * gravity(i);
    for (const Pin<Dim>& pin : parts_.pins) {
        const Vector<Dim> pull = pin_force(pin, q_0, q_1);
        for (const std::int32_t node : pin.nodes) force[node] += pull;
    }
}

template <int Dim>
Vector<Dim> P1Bodies<Dim>::pin_force(const Pin<Dim>& pin, std::span<const double> q_0, std::span<const double> q_1) const {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const std::int32_t node : pin.nodes) sum += 0.5 * (as_vectors<Dim>(q_0)[node] + as_vectors<Dim>(q_1)[node]);
    const auto n = static_cast<double>(pin.nodes.size());
    return -pin.stiffness / (n * n) * sum;
}

template <int Dim>
void P1Bodies<Dim>::place(std::span<const double> q, double t, std::vector<Vector<Dim>>& x) const {
    const auto u = as_vectors<Dim>(q);
    for (std::size_t i = 0; i < u.size(); ++i) x[i] = rest_[i] + u[i];
    std::size_t node = u.size();
    for (const auto& obstacle : scene_.solid.obstacles) {
        const auto placement = obstacle.placement ? obstacle.placement(t) : contact::Placement<Dim>{};
        for (const auto& corners : obstacle.faces)
            for (std::size_t i = 0; i < corners.size(); ++i, ++node) x[node] = placement(rest_[node]);
    }
}

template <int Dim>
void P1Bodies<Dim>::force(std::span<const double> q, std::span<double> f) {
    std::ranges::fill(f, 0.0);
    add_bulk(q, q, f);
    add_outside(q, q, f);
    place(q, time_, x_1_);
    contact_.evaluate(x_1_).add_force_to(f);
}

template <int Dim>
void P1Bodies<Dim>::follow(std::span<const double> q_0, std::span<const double> q_1, double t, double dt,
                           contact::TakenForce take, std::span<double> f) {
    const std::span<const double> from = take == contact::TakenForce::mean ? q_0 : q_1;
    std::ranges::fill(f, 0.0);
    add_bulk(from, q_1, f);
    add_outside(from, q_1, f);
    place(q_0, t, x_0_);
    place(q_1, t + dt, x_1_);
    time_ = t + dt;
    const contact::NodalStep<Dim>& step = contact_.step(dt, x_0_, x_1_, take);
    work_ += step.work;
    step.add_force_to(f);
    pair_steps_ += static_cast<std::int64_t>(step.pairs.size());
    double forces = 0.0;
    for (const auto& pair : step.pairs) forces += pair.force.norm();
    forces_ += forces;
    corrections_ += step.report.correction * forces;
}

template <int Dim>
void P1Bodies<Dim>::mean_force(std::span<const double> q_0, std::span<const double> q_1, double t, double dt,
                               std::span<double> f) {
    follow(q_0, q_1, t, dt, contact::TakenForce::mean, f);
}

template <int Dim>
void P1Bodies<Dim>::end_force(std::span<const double> q_0, std::span<const double> q_1, double t, double dt,
                              std::span<double> f) {
    follow(q_0, q_1, t, dt, contact::TakenForce::end, f);
}

template <int Dim>
double P1Bodies<Dim>::potential(std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    double energy = 0.0;
    for (const Element& element : elements_) {
        const Matrix<Dim> g = gradient(element, q);
        Matrix<Dim> strain = 0.5 * (g + g.transpose());
        if (is_finite_) strain += 0.5 * g.transpose() * g;
        energy += 0.5 * element.measure * hooke<Dim>(element.lambda, element.mu, strain).cwiseProduct(strain).sum();
    }
    for (std::size_t i = 0; i < mass_.size(); ++i) energy -= mass_[i] * gravity(i).dot(u[i]);
    for (const Pin<Dim>& pin : parts_.pins) {
        Vector<Dim> mean = Vector<Dim>::Zero();
        for (const std::int32_t node : pin.nodes) mean += u[node] / static_cast<double>(pin.nodes.size());
        energy += 0.5 * pin.stiffness * mean.squaredNorm();
    }
    place(q, time_, x_1_);
    return energy + contact_.evaluate(x_1_).energy;
}

template <int Dim>
void P1Bodies<Dim>::stiffness_product(std::span<const double> q, std::span<double> product) {
    std::ranges::fill(product, 0.0);
    for (const Element& element : elements_) {
        const Matrix<Dim> g = gradient(element, q);
        const Matrix<Dim> stress =
            element.measure * hooke<Dim>(element.lambda, element.mu, Matrix<Dim>(0.5 * (g + g.transpose())));
        for (int i = 0; i < Dim + 1; ++i) as_vectors<Dim>(product)[element.node[i]] += stress * element.slope[i];
    }
}

template <int Dim>
contact::NodalStableStep P1Bodies<Dim>::stable_step() {
    std::vector<double> mass = mass_;
    mass.resize(rest_.size(), 0.0);
    return contact_.stable_step(mass, dynamics::bound_of(dynamics::highest_mode(*this)));
}

template <int Dim>
std::vector<Matrix<Dim>> P1Bodies<Dim>::mean_gradients(std::span<const double> q) const {
    const auto n = static_cast<std::size_t>(mesh().n_bodies());
    std::vector<Matrix<Dim>> mean(n, Matrix<Dim>::Zero());
    std::vector<double> volume(n, 0.0);
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        const auto body = static_cast<std::size_t>(mesh().cell_body[i]);
        mean[body] += elements_[i].measure * gradient(elements_[i], q);
        volume[body] += elements_[i].measure;
    }
    for (std::size_t body = 0; body < n; ++body) mean[body] /= volume[body];
    return mean;
}

template <int Dim>
std::vector<double> P1Bodies<Dim>::rotations(std::span<const double> q) const {
    std::vector<double> angles;
    for (const Matrix<Dim>& mean : mean_gradients(q)) {
        const Matrix<Dim> f = Matrix<Dim>::Identity() + mean;
        const Eigen::Transform<double, Dim, Eigen::Affine> motion(
            Eigen::Map<const Eigen::Matrix<double, Dim, Dim>>(f.data()).eval());
        if constexpr (Dim == 2)
            angles.push_back(std::abs(Eigen::Rotation2Dd(motion.rotation()).angle()));
        else
            angles.push_back(Eigen::AngleAxisd(motion.rotation()).angle());
    }
    return angles;
}

template <int Dim>
std::vector<Matrix<Dim>> P1Bodies<Dim>::stresses(std::span<const double> q) const {
    std::vector<Matrix<Dim>> result;
    for (const Element& element : elements_) {
        const Matrix<Dim> g = gradient(element, q);
        Matrix<Dim> stress = stress_between(element, g, g);
        if (is_finite_) {
            const Matrix<Dim> stretch = Matrix<Dim>::Identity() + g;
            stress = stress * stretch.transpose() / stretch.determinant();
        }
        result.push_back(stress);
    }
    return result;
}

template class P1Bodies<2>;
template class P1Bodies<3>;

}  // namespace abut::studies::nodal
