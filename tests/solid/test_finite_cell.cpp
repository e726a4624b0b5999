// One cell of a body of Kinematics::finite: its free faces are where its energy is least, and steps between two gradients are
// exact.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/base/decompositions.hpp"
#include "abut/base/rotation.hpp"
#include "abut/solid/cells/edge_step.hpp"
#include "abut/solid/cells/finite_cell.hpp"
#include "abut/solid/material/material.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::CondensedStep;
using solid::EdgeStep;
using solid::FreeCell;

namespace {

const solid::Material material{.young = 1.0, .poisson = 0.3};

template <int Dim>
Matrix<Dim> random_matrix(unsigned seed, double size) {
    const auto values = random_state(Dim * Dim, seed, size);
    return Matrix<Dim>(values.data());
}

template <int Dim>
Matrix<Dim> random_rotation(unsigned seed) {
    if constexpr (Dim == 2)
        return rotation_in_plane(random_state(1, seed, 3.0)[0]);
    else
        return Eigen::Quaterniond(Eigen::Vector4d(random_state(4, seed).data())).normalized().toRotationMatrix();
}

template <int Dim>
FreeCell<Dim> cell_with(int n_tangents, unsigned seed) {
    return {.cell = 0, .n_tangents = n_tangents, .axes = random_rotation<Dim>(seed), .to_faces = Matrix<Dim>::Identity()};
}

template <int Dim>
Matrix<Dim> strain_of(const Matrix<Dim>& f) {
    return 0.5 * (f.transpose() * f - Matrix<Dim>::Identity());
}

template <int Dim>
Matrix<Dim> stress_of(const Matrix<Dim>& f) {
    const Matrix<Dim> strain = strain_of<Dim>(f);
    return material.lambda() * strain.trace() * Matrix<Dim>::Identity() + 2.0 * material.mu() * strain;
}

/// psi of St. Venant and Kirchhoff.
template <int Dim>
double density(const Matrix<Dim>& f) {
    return 0.5 * stress_of<Dim>(f).cwiseProduct(strain_of<Dim>(f)).sum();
}

template <int Dim>
double condensed_density(const FreeCell<Dim>& free, const Matrix<Dim>& f) {
    const Matrix<Dim> strain = strain_of<Dim>(f);
    return 0.5 * solid::condensed_stress<Dim>(free, material.lambda(), material.mu(), strain).cwiseProduct(strain).sum();
}

double contraction() { return solid::contraction(material.lambda(), material.mu()); }

/// F with the columns that free faces change where the energy is least, by the closed forms of plane stress, of a bar and of a
/// body without stress.
template <int Dim>
Matrix<Dim> relaxed(const FreeCell<Dim>& free, const Matrix<Dim>& f) {
    const Matrix<Dim> g = f - Matrix<Dim>::Identity();
    if (free.has_one_normal())
        return Matrix<Dim>::Identity() + CondensedStep<Dim>(free, contraction(), g, Matrix<Dim>::Zero()).mean();
    if (free.n_tangents == 0) return random_rotation<Dim>(5);
    if constexpr (Dim == 3) {
        const Vector<3> t = free.axes.col(0), y = f * free.axes.col(0);
        const double lateral = std::sqrt(1.0 + material.poisson * (1.0 - y.squaredNorm()));
        const Matrix<3> turn = rotation_between(t, y);
        return y * t.transpose() + lateral * turn * (Matrix<3>::Identity() - t * t.transpose());
    }
    return f;  // in the plane all cells are of one of the kinds above
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the condensed energy of a cell is the least over its free faces", "[solid][finite]",
                       ((int Dim), Dim), 2, 3) {
    for (int n_tangents = 0; n_tangents < Dim; ++n_tangents)
        for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
            CAPTURE(n_tangents, seed);
            const FreeCell<Dim> free = cell_with<Dim>(n_tangents, seed);
            const Matrix<Dim> f =
                random_rotation<Dim>(seed + 10) * (Matrix<Dim>::Identity() + random_matrix<Dim>(seed + 20, 0.2));
            const Matrix<Dim> least = relaxed<Dim>(free, f);
            const double energy = density<Dim>(least);
            Matrix<Dim> tangents = Matrix<Dim>::Zero();
            for (int k = 0; k < n_tangents; ++k) tangents += free.axes.col(k) * free.axes.col(k).transpose();
            const Matrix<Dim> normals = Matrix<Dim>::Identity() - tangents;
            CHECK(((least - f) * tangents).norm() * (n_tangents > 0) <= 1e-14);
            CHECK(std::abs(condensed_density<Dim>(free, f) - energy) <= 1e-14);
            CHECK((least * stress_of<Dim>(least) * normals).norm() <= 1e-14);
            for (const double size : {1e-3, 1e-1})
                for (unsigned k = 0; k < 20; ++k)
                    CHECK(density<Dim>(least + random_matrix<Dim>(100 + k, size) * normals) >= energy - 1e-16);
            // A condensed stress has no traction on the free faces.
            CHECK(
                (solid::condensed_stress<Dim>(free, material.lambda(), material.mu(), strain_of<Dim>(f)) * normals).norm() <=
                1e-15);
        }
}

TEMPLATE_TEST_CASE_SIG("gradients pulled back through a free face do the work of the step, and have no moment of their own",
                       "[solid][finite]", ((int Dim), Dim), 2, 3) {
    for (const double size : {0.3, 1e-2, 1e-5, 1e-9, 1e-17})
        for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
            CAPTURE(size, seed);
            const FreeCell<Dim> free = cell_with<Dim>(Dim - 1, seed);
            const Matrix<Dim> g =
                random_rotation<Dim>(seed + 10) * (Matrix<Dim>::Identity() + random_matrix<Dim>(seed + 20, 0.15)) -
                Matrix<Dim>::Identity();
            const Matrix<Dim> change = random_matrix<Dim>(seed + 30, size), p = random_matrix<Dim>(seed + 40, 1.0);
            const auto at = [&](double s) {
                return CondensedStep<Dim>(free, contraction(), g + s * change, Matrix<Dim>::Zero()).mean();
            };
            const CondensedStep<Dim> step(free, contraction(), g, change);
            const Matrix<Dim> pulled = step.pull_back(p);
            const Matrix<Dim> start = at(-0.5), end = at(0.5);
            CHECK((step.mean() - 0.5 * (start + end)).norm() <= 1e-15);
            CHECK(std::abs(pulled.cwiseProduct(change).sum() - p.cwiseProduct(end - start).sum()) <= 5e-15);
            const Matrix<Dim> mean = Matrix<Dim>::Identity() + step.mean(), affine = Matrix<Dim>::Identity() + g;
            const Matrix<Dim> torque = pulled * affine.transpose() - p * mean.transpose();
            CHECK((torque - torque.transpose()).norm() <= 2e-14);
        }
}

TEMPLATE_TEST_CASE_SIG("at edges and corners what is pulled back does the work of the step, and has no moment of its own",
                       "[solid][finite]", ((int Dim), Dim), 2, 3) {
    for (int n_tangents = 0; n_tangents < Dim - 1; ++n_tangents)
        for (const double size : {0.3, 1e-2, 1e-5, 1e-9, 1e-17})
            for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
                CAPTURE(n_tangents, size, seed);
                const FreeCell<Dim> free = cell_with<Dim>(n_tangents, seed);
                const Matrix<Dim> g =
                    random_rotation<Dim>(seed + 10) * (Matrix<Dim>::Identity() + random_matrix<Dim>(seed + 20, 0.15)) -
                    Matrix<Dim>::Identity();
                const Matrix<Dim> change = random_matrix<Dim>(seed + 30, size), p = random_matrix<Dim>(seed + 40, 1.0);
                const EdgeStep<Dim> step(free, material.poisson, {1.1, 1.1}, g, change);
                const Matrix<Dim> pulled = step.pull_back(p);
                const auto at = [&](double s) {
                    return solid::edge_gradient<Dim>(free, material.poisson, 1.1, g + s * change);
                };
                const Matrix<Dim> start = at(-0.5), end = at(0.5);
                CHECK((step.mean() - 0.5 * (start + end)).norm() <= 2e-15);
                CHECK((step.change() - (end - start)).norm() <= 4e-15);
                CHECK(std::abs(pulled.cwiseProduct(change).sum() - p.cwiseProduct(step.change()).sum()) <= 5e-15);
                const Matrix<Dim> mean = Matrix<Dim>::Identity() + step.mean(), affine = Matrix<Dim>::Identity() + g;
                const Matrix<Dim> torque = pulled * affine.transpose() - p * mean.transpose();
                CHECK((torque - torque.transpose()).norm() <= 2e-14);
            }
}

TEMPLATE_TEST_CASE_SIG("free faces at edges and corners bear nothing under strains that are small", "[solid][finite]",
                       ((int Dim), Dim), 2, 3) {
    for (int n_tangents = 0; n_tangents < Dim - 1; ++n_tangents)
        for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
            CAPTURE(n_tangents, seed);
            const FreeCell<Dim> free = cell_with<Dim>(n_tangents, seed);
            const double small = 1e-5;
            const Matrix<Dim> turn = random_rotation<Dim>(seed + 10);
            const Matrix<Dim> f = turn * (Matrix<Dim>::Identity() + random_matrix<Dim>(seed + 20, small));
            const Matrix<Dim> condensed = Matrix<Dim>::Identity() + solid::edge_gradient<Dim>(free, material.poisson, 1.0,
                                                                                              f - Matrix<Dim>::Identity());
            for (int k = 0; k < n_tangents; ++k) CHECK(((condensed - f) * free.axes.col(k)).norm() <= 1e-15);
            for (int k = n_tangents; k < Dim; ++k)
                CHECK((condensed * stress_of<Dim>(condensed) * free.axes.col(k)).norm() <= 10.0 * small * small);
            // It turns with its neighbours: what is left beside the tangents of the affine faces is a strain.
            const Matrix<Dim> off = turn.transpose() * (condensed - f);
            for (int i = n_tangents; i < Dim; ++i)
                for (int j = i + 1; j < Dim; ++j) {
                    const Vector<Dim>&a = free.axes.col(i), b = free.axes.col(j);
                    CHECK(std::abs(a.dot(off * b) - b.dot(off * a)) <= 10.0 * small * small);
                }
        }
}

TEST_CASE("a corner turns with its cell by any angle, and swells with heat", "[solid][finite]") {
    const FreeCell<3> free = cell_with<3>(0, 3);
    const Matrix<3> turn = rotation_about(Vector<3>(0.6, 0.0, 0.8), 2.5);
    const Matrix<3> stretched =
        turn * (Matrix<3>::Identity() + Matrix<3>{{0.2, 0.1, 0.0}, {0.1, -0.1, 0.0}, {0.0, 0.0, 0.3}});
    const Matrix<3> condensed = solid::edge_gradient<3>(free, material.poisson, 1.0, stretched - Matrix<3>::Identity());
    CHECK((condensed + Matrix<3>::Identity() - turn).norm() <= 1e-14);
    // From 1 to 1.02 without a motion: an isotropic body in space swells by that.
    const EdgeStep<3> heated(free, material.poisson, {1.0, 1.02}, stretched - Matrix<3>::Identity(), Matrix<3>::Zero());
    CHECK((heated.change() - 0.02 * turn).norm() <= 1e-14);
}

TEMPLATE_TEST_CASE_SIG("in one state what is pulled back is the derivative", "[solid][finite]", ((int Dim), Dim), 2, 3) {
    const FreeCell<Dim> free = cell_with<Dim>(Dim - 1, 3);
    const Matrix<Dim> g = random_rotation<Dim>(4) - Matrix<Dim>::Identity() + random_matrix<Dim>(5, 0.1);
    const Matrix<Dim> p = random_matrix<Dim>(6, 1.0), zero = Matrix<Dim>::Zero();
    const Matrix<Dim> pulled = CondensedStep<Dim>(free, contraction(), g, zero).pull_back(p);
    for (const unsigned seed : {7u, 8u, 9u}) {
        const Matrix<Dim> d = random_matrix<Dim>(seed, 1.0);
        const double h = 1e-5;
        const auto at = [&](double s) {
            return p.cwiseProduct(CondensedStep<Dim>(free, contraction(), g + s * d, zero).mean()).sum();
        };
        CHECK(std::abs((at(h) - at(-h)) / (2.0 * h) - pulled.cwiseProduct(d).sum()) <= 1e-8);
    }
}

TEMPLATE_TEST_CASE_SIG("a free face has no stretch left where its tangents are stretched too far", "[solid][finite]",
                       ((int Dim), Dim), 2, 3) {
    const FreeCell<Dim> free = cell_with<Dim>(Dim - 1, 3);
    const Matrix<Dim> tangents = Matrix<Dim>::Identity() - free.normal() * free.normal().transpose();
    // 1 + nu' (d - 1 - (d - 1) l^2) = 0
    const double limit = std::sqrt(1.0 + 1.0 / ((Dim - 1) * contraction()));
    const auto at = [&](double stretch) {
        return solid::normal_stretch_squared<Dim>(free, contraction(), (stretch - 1.0) * tangents);
    };
    CHECK(std::abs(at(limit)) <= 1e-14);
    CHECK(at(0.9 * limit) > 0.0);
    CHECK(at(1.1 * limit) < 0.0);
}
