#pragma once
// Bodies of Kinematics::finite: states, steps and collisions that their tests share.
#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "solid/turning_scenes.hpp"

namespace abut::test {

/// A displacement gradient of random components up to `size`.
template <int Dim>
Matrix<Dim> some_gradient(unsigned seed, double size) {
    Matrix<Dim> g;
    const auto values = random_state(Dim * Dim, seed, size);
    for (int i = 0; i < Dim * Dim; ++i) g.data()[i] = values[static_cast<std::size_t>(i)];
    return g;
}

/// Displacements of all cells under a rigid motion, with noise.
template <int Dim>
std::vector<double> turned_state(const mesh::Mesh<Dim>& mesh, double angle, unsigned seed, double noise) {
    std::vector<double> q = sampled<Dim>(mesh, [&](const Vector<Dim>& x) -> Vector<Dim> {
        return turned_by<Dim>(angle) * x - x + Vector<Dim>::Constant(0.3);
    });
    const auto added = random_state(q.size(), seed, noise);
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += added[i];
    return q;
}

/// W and P of St. Venant and Kirchhoff's material, which the operators also know in closed form.
template <int Dim>
solid::Response<Dim> linear_in_green_strain(const solid::Material& material, const Matrix<Dim>& g) {
    const Matrix<Dim> e = 0.5 * (g + g.transpose() + g.transpose() * g);
    const Matrix<Dim> s = material.lambda() * e.trace() * Matrix<Dim>::Identity() + 2.0 * material.mu() * e;
    return {.energy = 0.5 * s.cwiseProduct(e).sum(), .stress = s + g * s};
}

/// Finite bodies of one material, in contact.
template <int Dim>
solid::SolidOptions<Dim> finite_of(const solid::Material& material, int n_bodies = 1) {
    auto options = bodies<Dim>(n_bodies);
    options.materials.assign(static_cast<std::size_t>(n_bodies), material);
    options.kinematics.assign(static_cast<std::size_t>(n_bodies), solid::Kinematics::finite);
    return options;
}

/// One finite body without contact.
template <int Dim>
solid::SolidOptions<Dim> alone(const solid::Material& material) {
    auto options = finite_of<Dim>(material);
    options.contact.reset();
    return options;
}

/// Two bodies that meet while they spin: discs, boxes in space. Under MEMM at 0.6 of 2/omega.
template <int Dim>
std::unique_ptr<TurningScene<Dim>> spinning_collision(const solid::SolidOptions<Dim>& options,
                                                      solid::Kinematics second = solid::Kinematics::finite) {
    std::vector<Motion<Dim>> motion(2);
    for (int body = 0; body < 2; ++body) {
        if constexpr (Dim == 2)
            motion[body].velocity = disc_velocities[body];
        else
            motion[body].velocity = box_velocities[body];
        motion[body].spin = some_spin<Dim>(body == 0 ? 0.02 : -0.03);
    }
    const auto mesh = [] {
        if constexpr (Dim == 2)
            return two_discs(0.5);
        else
            return two_boxes(3);
    }();
    return std::make_unique<TurningScene<Dim>>(mesh, options, motion, 0.6, std::vector{solid::Kinematics::finite, second});
}

/// Steps that take the two bodies of `spinning_collision` through it.
template <int Dim>
inline constexpr int steps_of_collision = Dim == 2 ? 600 : 250;

/// Makes these steps. The largest fall of what has been dissipated by one of these kinds in one of them [J]: 0, or materials have given
/// energy back.
template <int Dim, class... Kinds>
double fall_of_dissipation(TurningScene<Dim>& scene, int steps, Kinds... kinds) {
    double fall = 0.0;
    for (int step = 0; step < steps; ++step) {
        const dynamics::Losses before = scene.solid.dissipated();
        scene.run(1);
        const dynamics::Losses after = scene.solid.dissipated();
        (raise(fall, std::invoke(kinds, before) - std::invoke(kinds, after)), ...);
    }
    return fall;
}

/// What one step leaves of energy, momentum and moment about the mean positions, over sums of absolute values.
template <int Dim>
struct StepErrors {
    double energy = 0.0, momentum = 0.0, angular = 0.0;

    StepErrors(solid::Solid<Dim>& solid, const std::vector<double>& q_0, const std::vector<double>& q_1) {
        std::vector<double> force_on(q_0.size());
        solid.mean_force(q_0, q_1, 0.0, 1.0, force_on);
        double work = 0.0, of_work = 0.0, of_moment = 0.0, of_force = 0.0;
        Vector<Dim> sum = Vector<Dim>::Zero();
        AxialVector<Dim> turning = AxialVector<Dim>::Zero();
        for (std::size_t i = 0; i < q_0.size() / Dim; ++i) {
            const Vector<Dim> f = vectors<Dim>(force_on)[i], u_0 = vectors<Dim>(q_0)[i], u_1 = vectors<Dim>(q_1)[i];
            const Vector<Dim> x = solid.rest_positions()[i] + 0.5 * (u_0 + u_1);
            work += f.dot(u_1 - u_0);
            of_work += std::abs(f.dot(u_1 - u_0));
            sum += f;
            of_force += f.norm();
            turning += moment<Dim>(x, f);
            of_moment += x.norm() * f.norm();
        }
        const double v_0 = solid.potential(q_0), v_1 = solid.potential(q_1);
        energy = std::abs(v_1 - v_0 + work) / (of_work + v_0 + v_1);
        momentum = sum.norm() / of_force;
        angular = turning.norm() / of_moment;
    }
};

/// How far -force . d in q is from the slope of the energy along random d, over that.
template <int Dim>
double slope_error(solid::Solid<Dim>& solid, const std::vector<double>& q) {
    const auto d = random_state(q.size(), 3);
    std::vector<double> force(q.size());
    solid.force(q, force);
    double power = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) power -= force[i] * d[i];
    const auto at = [&](double s) {
        auto x = q;
        for (std::size_t i = 0; i < q.size(); ++i) x[i] += s * d[i];
        return solid.potential(x);
    };
    constexpr double h = 1e-6;
    return std::abs((at(h) - at(-h)) / (2.0 * h) - power) / std::abs(power);
}

/// After `steps` steps of 0.05, thrown along x, a solid that takes the state over ends 20 steps later with the bits of the first.
inline void check_that_it_goes_on(const mesh::Mesh<2>& mesh, const solid::SolidOptions<2>& options, int steps) {
    const std::vector<Vector<2>> velocity{{0.1, 0.0}};
    const auto run_of = [&](solid::Solid<2>& of) {
        return dynamics::Memm<solid::Solid<2>>(of, std::vector<double>(of.size(), 0.0),
                                               solid::uniform_momentum<2>(of, velocity), 0.05);
    };
    solid::Solid<2> whole(mesh, options), part(mesh, options);
    auto all = run_of(whole);
    for (int i = 0; i < steps; ++i) all.step();
    const auto of_solid = whole.state();
    const auto of_scheme = all.state();
    for (int i = 0; i < 20; ++i) all.step();
    auto rest = run_of(part);
    rest.restore(of_scheme);
    part.restore(of_solid, rest.q());
    for (int i = 0; i < 20; ++i) rest.step();
    CHECK(std::ranges::equal(all.q(), rest.q()));
    CHECK(whole.work() == part.work());
}

}  // namespace abut::test
