#include <catch2/catch.hpp>

#include "contact/reference.hpp"
#include "contact/surfaces.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using contact::ContactOptions;
using contact::Cuts;
using contact::OverlapMode;
using contact::Weights;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <int Dim>
std::vector<Vector<Dim>> as_vectors(const VectorXd& x) {
    std::vector<Vector<Dim>> v;
    for (Eigen::Index i = 0; i < x.size(); i += Dim) v.emplace_back(x.segment<Dim>(i));
    return v;
}

template <int Dim>
VectorXd as_column(std::span<const Vector<Dim>> v) {
    VectorXd x(static_cast<Eigen::Index>(v.size()) * Dim);
    for (std::size_t i = 0; i < v.size(); ++i) x.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = v[i];
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
                Matrix<Dim> block = Matrix<Dim>::NullaryExpr([&] { return uniform(random, -1.0, 1.0); });
                if (f == g) block = block * block.transpose() + 8.0 * Matrix<Dim>::Identity();
                q_ff.block<Dim, Dim>(f * Dim, g * Dim) = block;
                q_ff.block<Dim, Dim>(g * Dim, f * Dim) = block.transpose();
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
    std::vector<std::int32_t> local_face;

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
            local_face.push_back(i);
            for (std::int32_t j = i + 1; j < surface.size(); ++j)
                if (surface.body[i] != surface.body[j] && surface.normal[i].dot(surface.normal[j]) < -0.5)
                    pairs.emplace_back(i, j);
        }
    }

    [[nodiscard]] contact::PairList<Dim> pair_list(Weights weights) const {
        contact::PairList<Dim> list;
        for (const auto& [i, j] : pairs) list.append(surface.view(), i, j, weights);
        for (auto& pair : list.pairs()) pair.admitted = true;
        return list;
    }

    [[nodiscard]] contact::PathIntegral<Dim> integral(const ContactOptions& options, Cuts cuts = Cuts::coupled) const {
        contact::PathIntegral<Dim> result(options);
        const auto w_0 = as_vectors<Dim>(host.r * u_0), w_1 = as_vectors<Dim>(host.r * u_1);
        const auto y_0 = as_vectors<Dim>(host.free_force(u_0)), y_1 = as_vectors<Dim>(host.free_force(u_1));
        result.integrate(surface.view(), pair_list(options.weights), local_face, host.coupling, {w_0, w_1, y_0, y_1}, cuts);
        return result;
    }

    /// F . du + V_1 - V_0 over the size of its terms, with V by the reference.
    [[nodiscard]] double energy_defect(const ContactOptions& options) const {
        const auto result = integral(options);
        const Reference<Dim> reference(surface.view(), pairs, options.weights);
        const auto v = [&](const VectorXd& u) {
            return host.potential(
                u, as_column<Dim>(std::span<const Vector<Dim>>(reference.corrections(as_vectors<Dim>(host.r * u)))));
        };
        const VectorXd force =
            host.mean_force(u_0, u_1, as_column<Dim>(result.mean_correction()), as_column<Dim>(result.mean_force()));
        const double v_0 = v(u_0), v_1 = v(u_1);
        return std::abs(force.dot(u_1 - u_0) + v_1 - v_0) /
               (std::abs(v_0) + std::abs(v_1) + force.cwiseAbs().dot((u_1 - u_0).cwiseAbs()));
    }
};

double largest(const VectorXd& x) { return x.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

}  // namespace

TEMPLATE_TEST_CASE_SIG("mean corrections and pair forces are those of an adaptive quadrature of the formulas of the method",
                       "[contact][path]", ((int Dim), Dim), 2, 3) {
    const int seed = GENERATE(1, 2, 3);
    ContactOptions options;
    options.weights = GENERATE(Weights::stiffness, Weights::half);
    const Scene<Dim> scene(seed);
    const Reference<Dim> reference(scene.surface.view(), scene.pairs, options.weights);
    const auto at = [&](double tau) {
        const VectorXd u = scene.u_0 + tau * (scene.u_1 - scene.u_0);
        const auto w = as_vectors<Dim>(scene.host.r * u);
        const VectorXd delta = as_column<Dim>(std::span<const Vector<Dim>>(reference.corrections(w)));
        const auto y = as_vectors<Dim>(scene.host.free_force(u) + scene.host.q_ff * delta);
        VectorXd both(2 * delta.size());
        both << delta, as_column<Dim>(std::span<const Vector<Dim>>(reference.pair_forces(w, y)));
        return both;
    };
    const VectorXd expected = AdaptiveMean(at, largest(at(0.0)) + largest(at(1.0))).over_unit_interval();
    const Eigen::Index n = expected.size() / 2;

    const auto result = scene.integral(options);
    CHECK(result.active_pairs().size() > 5);
    CHECK(result.events() > 5);
    CHECK(largest(as_column<Dim>(result.mean_correction()) - expected.head(n)) < 1e-11 * largest(expected.head(n)));
    CHECK(largest(as_column<Dim>(result.mean_force()) - expected.tail(n)) < 1e-11 * largest(expected.tail(n)));
}

TEMPLATE_TEST_CASE_SIG(
    "the work of the mean force is the change of the potential to round-off, for any way through any contact",
    "[contact][path]", ((int Dim), Dim), 2, 3) {
    ContactOptions options;
    options.weights = GENERATE(Weights::stiffness, Weights::half);
    options.area = GENERATE(geometry::AreaMethod::fast, geometry::AreaMethod::exact);
    const int seeds = options.area == geometry::AreaMethod::fast ? 200 : 10;
    double worst = 0.0;
    for (int seed = 0; seed < seeds; ++seed) raise(worst, Scene<Dim>(seed).energy_defect(options));
    CHECK(worst < 1e-14);
}

TEMPLATE_TEST_CASE_SIG(
    "the work is exact with hundreds of pairs at once, enough to be integrated concurrently, and the same bits come out "
    "every time",
    "[contact][path]", ((int Dim), Dim), 2, 3) {
    for (int seed = 0; seed < 5; ++seed) {
        const Scene<Dim> scene(seed, true, 25);
        const auto once = scene.integral({}), again = scene.integral({});
        CHECK(once.active_pairs().size() > 200);
        CHECK(scene.energy_defect({}) < 1e-14);
        CHECK(as_column<Dim>(once.mean_force()) == as_column<Dim>(again.mean_force()));
        CHECK(as_column<Dim>(once.mean_correction()) == as_column<Dim>(again.mean_correction()));
        const VectorXd global = as_column<Dim>(scene.integral({}, Cuts::global).mean_force());
        CHECK(largest(as_column<Dim>(once.mean_force()) - global) < 1e-14 * largest(global));
    }
}

TEMPLATE_TEST_CASE_SIG(
    "without events, or with too few points, the work misses the change of the potential by orders of magnitude",
    "[contact][path]", ((int Dim), Dim), 2, 3) {
    ContactOptions worse;
    SECTION("events off") { worse.events = false; }
    SECTION("events off, three points") {
        worse.events = false;
        worse.quadrature = 3;
    }
    SECTION("one point too few") { worse.quadrature = Dim - 1; }
    double exact = 0.0, defect = 0.0;
    for (int seed = 0; seed < 20; ++seed) {
        const Scene<Dim> scene(seed);
        raise(exact, scene.energy_defect({}));
        raise(defect, scene.energy_defect(worse));
    }
    CHECK(defect > 1e-8);
    CHECK(defect > 1e6 * exact);
}

TEMPLATE_TEST_CASE_SIG("cutting at the events of coupled pairs gives what cutting at all events of the scene gives",
                       "[contact][path]", ((int Dim), Dim), 2, 3) {
    double worst = 0.0;
    for (int seed = 0; seed < 100; ++seed) {
        const Scene<Dim> scene(seed);
        const auto local = scene.integral({}, Cuts::coupled), global = scene.integral({}, Cuts::global);
        const VectorXd f = as_column<Dim>(global.mean_force());
        raise(worst, largest(as_column<Dim>(local.mean_force()) - f) / largest(f));
        CHECK(largest(as_column<Dim>(local.mean_correction()) - as_column<Dim>(global.mean_correction())) == 0.0);
    }
    CHECK(worst < 1e-14);
}

TEMPLATE_TEST_CASE_SIG("the forces of a pair are opposite, those of all pairs sum to zero", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    for (int seed = 0; seed < 50; ++seed) {
        Scene<Dim> scene(seed);
        const auto all = scene.integral({});
        Vector<Dim> sum = Vector<Dim>::Zero();
        double size = 0.0;
        for (const Vector<Dim>& force : all.mean_force()) {
            sum += force;
            size += force.norm();
        }
        CHECK(sum.norm() <= 1e-15 * size);
        for (const auto& pair : std::vector(scene.pairs)) {
            scene.pairs = {pair};
            const auto alone = scene.integral({});
            CHECK(alone.mean_force()[static_cast<std::size_t>(pair.first)] ==
                  -alone.mean_force()[static_cast<std::size_t>(pair.second)]);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("swapping the numbers of the two bodies leaves the forces on them as they are", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    for (int seed = 0; seed < 20; ++seed) {
        const Scene<Dim> scene(seed);
        auto swapped = scene;
        for (auto& [i, j] : swapped.pairs) std::swap(i, j);
        const VectorXd force = as_column<Dim>(scene.integral({}).mean_force());
        CHECK(largest(as_column<Dim>(swapped.integral({}).mean_force()) - force) < 1e-12 * largest(force));
    }
}

TEMPLATE_TEST_CASE_SIG("a frozen overlap conserves energy exactly where the overlap does not change", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    // Small faces of body 1 slide inside large faces of body 0: A is their own area all along.
    std::mt19937 random(7);
    ContactOptions frozen;
    frozen.overlap = OverlapMode::frozen;
    for (int trial = 0; trial < 20; ++trial) {
        contact::Surface<Dim> surface;
        for (int i = 0; i < 3; ++i)
            surface.append(tile<Dim>(8.0 * i * axis<Dim>(0), up<Dim>(), 3.0), 0.5, uniform(random, 1.0, 5.0), 0);
        for (int i = 0; i < 6; ++i)
            surface.append(random_face<Dim>(random, 8.0 * (i % 3) * axis<Dim>(0), -up<Dim>(), 0.5), 0.5,
                           uniform(random, 1.0, 5.0), 1);
        Scene<Dim> scene(surface, random);
        scene.u_0 = scene.host.cells_for(as_column<Dim>(random_displacement(random, surface, 0.5, 0.05)));
        scene.u_1 = scene.host.cells_for(as_column<Dim>(random_displacement(random, surface, 0.5, 0.05)));
        CHECK(scene.energy_defect(frozen) < 1e-14);
    }
    // Where it does change, it does not.
    double defect = 0.0;
    for (int seed = 0; seed < 10; ++seed) raise(defect, Scene<Dim>(seed).energy_defect(frozen));
    CHECK(defect > 1e-6);
}

TEMPLATE_TEST_CASE_SIG("pairs apart or not admitted give no correction, no force and no event", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    Scene<Dim> scene(4, false);
    auto list = scene.pair_list(Weights::stiffness);
    contact::PathIntegral<Dim> result({});
    auto w_0 = as_vectors<Dim>(scene.host.r * scene.u_0), w_1 = as_vectors<Dim>(scene.host.r * scene.u_1);
    const auto y = as_vectors<Dim>(scene.host.free_force(scene.u_0));
    SECTION("apart") {
        for (std::int32_t f = 0; f < scene.surface.size(); ++f)
            if (scene.surface.body[f] == 1) w_0[f] += 5.0 * up<Dim>(), w_1[f] += 5.0 * up<Dim>();
    }
    SECTION("not admitted") {
        for (auto& pair : list.pairs()) pair.admitted = false;
    }
    result.integrate(scene.surface.view(), list, scene.local_face, scene.host.coupling, {w_0, w_1, y, y});
    CHECK(result.active_pairs().empty());
    CHECK(result.events() == 0);
    CHECK(result.compression() == 0.0);
    CHECK(largest(as_column<Dim>(result.mean_correction())) == 0.0);
    CHECK(largest(as_column<Dim>(result.mean_force())) == 0.0);
}

TEMPLATE_TEST_CASE_SIG("what an instance has integrated before leaves no trace in its next result", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    const Scene<Dim> first(1), second(2);
    contact::PathIntegral<Dim> used({});
    for (const Scene<Dim>* scene : {&first, &second}) {
        const auto w_0 = as_vectors<Dim>(scene->host.r * scene->u_0), w_1 = as_vectors<Dim>(scene->host.r * scene->u_1);
        const auto y_0 = as_vectors<Dim>(scene->host.free_force(scene->u_0)),
                   y_1 = as_vectors<Dim>(scene->host.free_force(scene->u_1));
        used.integrate(scene->surface.view(), scene->pair_list(Weights::stiffness), scene->local_face, scene->host.coupling,
                       {w_0, w_1, y_0, y_1});
    }
    const auto fresh = second.integral({});
    CHECK(as_column<Dim>(used.mean_force()) == as_column<Dim>(fresh.mean_force()));
    CHECK(as_column<Dim>(used.mean_correction()) == as_column<Dim>(fresh.mean_correction()));
    CHECK(used.events() == fresh.events());
}
