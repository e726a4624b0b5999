#pragma once
// An artificial host and random scenes in which the law of contact is compared with the reference.
#include <Eigen/Dense>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/eigen.hpp"

#include "contact/law.hpp"
#include "contact/reference.hpp"
#include "contact/surfaces.hpp"

namespace abut::test {

using contact::ContactOptions;
using contact::Cuts;
using contact::InterfaceWeighting;
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <int Dim>
std::vector<Vector<Dim>> as_vectors(const VectorXd& x) {
    std::vector<Vector<Dim>> v;
    for (Eigen::Index i = 0; i < x.size(); i += Dim) v.emplace_back(x.segment<Dim>(i));
    return v;
}

template <int Dim>
VectorXd as_column(std::span<const Vector<Dim>> v) {
    VectorXd x(static_cast<Eigen::Index>(v.size()) * Dim);
    for (std::size_t i = 0; i < v.size(); ++i) x.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = as_eigen(v[i]);
    return x;
}

/// An artificial host: V(u, w) = 1/2 u.Qcc u + u.Qcf w + 1/2 w.Qff w with w = R u + delta, positive definite. Its faces
/// couple to the two next to them on either side, as those of neighbouring cells do.
template <int Dim>
struct Host {
    MatrixXd r, q_cc, q_cf, q_ff;
    contact::FaceCoupling<Dim> coupling;

    Host(std::mt19937& random, int n_faces) {
        const Eigen::Index n = n_faces * Dim;
        const auto noise = [&](double size) {
            return MatrixXd(MatrixXd::NullaryExpr(n, n, [&] { return uniform(random, -size, size); }));
        };
        r = MatrixXd::Identity(n, n) + noise(0.2 / n);
        q_cf = noise(1.0 / n);
        q_cc = 10.0 * MatrixXd::Identity(n, n);
        q_ff = MatrixXd::Zero(n, n);
        for (int f = 0; f < n_faces; ++f)
            for (int g = f; g < std::min(f + 3, n_faces); ++g) {
                Matrix<Dim> block;
                for (double& value : block) value = uniform(random, -1.0, 1.0);
                if (f == g) block = block * block.transpose() + 8.0 * Matrix<Dim>::Identity();
                q_ff.block<Dim, Dim>(f * Dim, g * Dim) = as_eigen(block);
                q_ff.block<Dim, Dim>(g * Dim, f * Dim) = as_eigen(block.transpose());
            }
        for (int f = 0; f < n_faces; ++f) {
            for (int g = std::max(0, f - 2); g < std::min(f + 3, n_faces); ++g) {
                coupling.columns.push_back(g);
                coupling.blocks.push_back(q_ff.block<Dim, Dim>(f * Dim, g * Dim));
            }
            coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
        }
    }

    [[nodiscard]] VectorXd cells_for(const VectorXd& face_displacement) const {
        return r.partialPivLu().solve(face_displacement);
    }
    [[nodiscard]] VectorXd free_force(const VectorXd& u) const { return q_cf.transpose() * u + q_ff * (r * u); }
    [[nodiscard]] double potential(const VectorXd& u, const VectorXd& delta) const {
        const VectorXd w = r * u + delta;
        return 0.5 * u.dot(q_cc * u) + u.dot(q_cf * w) + 0.5 * w.dot(q_ff * w);
    }
    /// Mean of F over a straight way; docs/method.md, Time.
    [[nodiscard]] VectorXd mean_force(const VectorXd& u_0, const VectorXd& u_1, const VectorXd& mean_delta,
                                      const VectorXd& mean_pair_force) const {
        const VectorXd u = 0.5 * (u_0 + u_1);
        const VectorXd free = q_cc * u + q_cf * (r * u) + r.transpose() * free_force(u);
        return -(free + (q_cf + r.transpose() * q_ff) * mean_delta + r.transpose() * mean_pair_force);
    }
};

/// A random scene, all of its facing pairs admitted, and a straight way through it.
template <int Dim>
struct Scene {
    contact::Surface<Dim> surface;
    Host<Dim> host;
    VectorXd u_0, u_1;
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    std::vector<contact::Face> faces;

    explicit Scene(int seed, bool with_obstacle = true, int faces_a_body = Dim == 2 ? 6 : 7)
        : Scene(std::mt19937(static_cast<unsigned>(seed)), with_obstacle, faces_a_body) {}
    Scene(std::mt19937 random, bool with_obstacle, int faces_a_body)
        : surface(make_surface(random, with_obstacle, faces_a_body)), host(random, surface.size()) {
        u_0 = host.cells_for(as_column<Dim>(random_displacement(random, surface, 0.4, 0.15)));
        u_1 = host.cells_for(as_column<Dim>(random_displacement(random, surface, 0.4, 0.15)));
        list_pairs();
    }
    Scene(contact::Surface<Dim> made, std::mt19937 random) : surface(std::move(made)), host(random, surface.size()) {
        list_pairs();
    }

    static contact::Surface<Dim> make_surface(std::mt19937& random, bool with_obstacle, int faces_a_body) {
        auto surface = random_surface<Dim>(random, faces_a_body, 0.4, 0.8);
        if (with_obstacle) contact::append(surface, contact::plane_obstacle<Dim>(-0.05 * up<Dim>(), up<Dim>(), 1.0), 2);
        return surface;
    }

    void list_pairs() {
        for (std::int32_t i = 0; i < surface.size(); ++i) {
            faces.push_back(contact::Face{i});
            for (std::int32_t j = i + 1; j < surface.size(); ++j)
                if (surface.body[i] != surface.body[j] && surface.normal[i].dot(surface.normal[j]) < -0.5)
                    pairs.emplace_back(i, j);
        }
    }

    [[nodiscard]] contact::PairList<Dim> pair_list(InterfaceWeighting weighting) const {
        contact::PairList<Dim> list;
        for (const auto& [i, j] : pairs) list.append(surface.view(), i, j, weighting);
        list.number_faces(faces);
        return list;
    }
    [[nodiscard]] std::vector<contact::PairMemory> memory(bool admitted = true) const {
        return std::vector<contact::PairMemory>(pairs.size(), {.admitted = admitted});
    }

    [[nodiscard]] contact::ContactStep<Dim> integral(const ContactOptions& options, Cuts cuts = Cuts::coupled) const {
        LawOnList<Dim> law(options);
        const auto w_0 = as_vectors<Dim>(host.r * u_0), w_1 = as_vectors<Dim>(host.r * u_1);
        const auto y_0 = as_vectors<Dim>(host.free_force(u_0)), y_1 = as_vectors<Dim>(host.free_force(u_1));
        return law(surface.view(), pair_list(options.weighting), memory(), faces, host.coupling, {w_0, w_1, y_0, y_1}, cuts);
    }

    /// F . du + V_1 - V_0 over the size of its terms, with V by the reference.
    [[nodiscard]] double energy_defect(const ContactOptions& options) const {
        const auto result = integral(options);
        const Reference<Dim> reference(surface.view(), pairs, options.weighting);
        const auto v = [&](const VectorXd& u) {
            return host.potential(
                u, as_column<Dim>(std::span<const Vector<Dim>>(reference.corrections(as_vectors<Dim>(host.r * u)))));
        };
        const VectorXd force = host.mean_force(u_0, u_1, as_column<Dim>(result.mean_correction.values()),
                                               as_column<Dim>(result.mean_gradient.values()));
        const double v_0 = v(u_0), v_1 = v(u_1);
        return std::abs(force.dot(u_1 - u_0) + v_1 - v_0) /
               (std::abs(v_0) + std::abs(v_1) + force.cwiseAbs().dot((u_1 - u_0).cwiseAbs()));
    }
};

}  // namespace abut::test
