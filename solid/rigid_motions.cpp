#include "abut/solid/rigid_motions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/contact_view.hpp"

namespace abut::solid {
namespace {

inline constexpr double stopped = 1e-10;  // of the firmest motion: below it nothing but rounding stops one
inline constexpr double closed = 1e-6;    // of a body's size: faces that near touch at once

template <int Dim>
inline constexpr int n_motions = Dim == 2 ? 3 : 6;
template <int Dim>
using Motions = SmallMatrix<Dim, n_motions<Dim>>;

/// Centre about which a body turns, and its size.
template <int Dim>
struct Frame {
    Vector<Dim> centre = Vector<Dim>::Zero();
    double radius = 0.0;  // of gyration [m]
};

template <int Dim>
std::vector<Frame<Dim>> frames(const mesh::Mesh<Dim>& mesh) {
    std::vector<Frame<Dim>> result(static_cast<std::size_t>(mesh.n_bodies()));
    std::vector<double> measure(result.size(), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        measure[body] += mesh.cell_measure[c];
        result[body].centre += mesh.cell_measure[c] * mesh.cell_centroid[c];
    }
    for (std::size_t body = 0; body < result.size(); ++body) result[body].centre /= measure[body];
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        result[body].radius +=
            mesh.cell_measure[c] / measure[body] * (mesh.cell_centroid[c] - result[body].centre).squaredNorm();
    }
    for (Frame<Dim>& frame : result) frame.radius = std::sqrt(frame.radius);
    return result;
}

/// Displacement of a point of a body in each of its rigid motions: translations, then rotations of size 1 at its radius.
template <int Dim>
Motions<Dim> motions_at(const Frame<Dim>& frame, const Vector<Dim>& x) {
    const Vector<Dim> r = (x - frame.centre) / frame.radius;
    Motions<Dim> result;
    for (int axis = 0; axis < Dim; ++axis) result.col(axis) = Vector<Dim>::Unit(axis);
    if constexpr (Dim == 2)
        result.col(2) = {-r.y(), r.x()};
    else
        for (int axis = 0; axis < 3; ++axis) result.col(3 + axis) = Vector<3>::Unit(axis).cross(r);
    return result;
}

/// How firmly motions are held: half of |what prescribed displacements, closed pairs and bonds take out of them|^2.
template <int Dim>
Eigen::MatrixXd hold(Solid<Dim>& solid, std::span<const double> q, const std::vector<Frame<Dim>>& frame) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    const auto n = static_cast<Eigen::Index>(frame.size()) * n_motions<Dim>;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    const auto body_at = [&](BoundaryFace b) { return mesh.cell_body[cell_of(mesh, b)]; };
    const auto motions = [&](BoundaryFace b) {
        return motions_at(frame[static_cast<std::size_t>(body_at(b))], mesh.face_centroid[mesh_face(mesh, b)]);
    };
    const auto prescribed = solid.ccg().prescribed();
    for (const BoundaryFace b : solid.ccg().boundary_faces()) {
        const Motions<Dim> held = prescribed[b] * motions(b);
        const Eigen::Index first = Eigen::Index{body_at(b)} * n_motions<Dim>;
        result.template block<n_motions<Dim>, n_motions<Dim>>(first, first) += as_eigen(held.transpose() * held);
    }
    const double size = std::ranges::max_element(frame, {}, [](const Frame<Dim>& one) { return one.radius; })->radius;
    for (const TouchingPair<Dim>& pair : solid.contact_at(q).touching_pairs(closed * size)) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
        const auto add = [&](BoundaryFace b, double sign) {
            if (b == no_face) return;
            row.segment<n_motions<Dim>>(Eigen::Index{body_at(b)} * n_motions<Dim>) +=
                as_eigen(sign * motions(b).transpose() * pair.normal);
        };
        add(pair.face_1, -1.0);
        add(pair.face_2, 1.0);
        result += row * row.transpose();
    }
    for (const BondPlace<Dim>& place : solid.bonds().places()) {
        Eigen::MatrixXd jump = Eigen::MatrixXd::Zero(Dim, n);
        for (std::size_t side = 0; side < 2; ++side) {
            const std::int32_t body = body_at(place.faces[side]);
            jump.middleCols<n_motions<Dim>>(Eigen::Index{body} * n_motions<Dim>) +=
                as_eigen((side == 0 ? -1.0 : 1.0) * motions_at(frame[static_cast<std::size_t>(body)], place.position));
        }
        result += jump.transpose() * jump;
    }
    return result;
}

template <int Dim>
std::string words_of_vector(const Vector<Dim>& v) {
    std::string result;
    for (int d = 0; d < Dim; ++d) result += (d == 0 ? "(" : ", ") + number(std::round(1e3 * v[d]) / 1e3 + 0.0);
    return result + ")";
}

/// The part of a motion that the body which moves most takes in it.
template <int Dim>
std::string describe(const mesh::Mesh<Dim>& mesh, const Eigen::VectorXd& motion) {
    Eigen::Index body = 0;
    const auto part = [&](Eigen::Index i) { return motion.segment<n_motions<Dim>>(i * n_motions<Dim>); };
    for (Eigen::Index i = 1; i < mesh.n_bodies(); ++i)
        if (part(i).norm() > part(body).norm() * (1.0 + 1e-6)) body = i;
    const Vector<Dim> shift = part(body).template head<Dim>();
    const auto turn = part(body).template tail<n_motions<Dim> - Dim>();
    const std::string name = "body " + std::to_string(body) + " ('" + mesh.body_names[static_cast<std::size_t>(body)] + "')";
    if (shift.norm() >= turn.norm()) return name + " is free to move along " + words_of_vector<Dim>(shift.normalized());
    if constexpr (Dim == 2)
        return name + " is free to turn";
    else
        return name + " is free to turn about the axis " + words_of_vector<3>(Vector<3>(turn.normalized()));
}

}  // namespace

template <int Dim>
std::optional<std::string> free_rigid_motion(Solid<Dim>& solid, std::span<const double> q) {
    const DenseEigen modes = symmetric_eigen(hold(solid, q, frames(solid.mesh())));
    if (modes.values[0] > stopped * modes.values.tail<1>()[0]) return std::nullopt;
    return describe(solid.mesh(), modes.vectors.col(0));
}

template std::optional<std::string> free_rigid_motion<2>(Solid<2>&, std::span<const double>);
template std::optional<std::string> free_rigid_motion<3>(Solid<3>&, std::span<const double>);

}  // namespace abut::solid
