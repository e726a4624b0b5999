#include <catch2/catch.hpp>

#include "contact/law_scene.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using contact::OverlapMode;

namespace {

double largest(const VectorXd& x) { return x.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

}  // namespace

TEMPLATE_TEST_CASE_SIG("mean corrections and pair forces are those of an adaptive quadrature of the formulas of the method",
                       "[contact][path]", ((int Dim), Dim), 2, 3) {
    const int seed = GENERATE(1, 2, 3);
    ContactOptions options;
    options.weighting = GENERATE(InterfaceWeighting::stiffness, InterfaceWeighting::half);
    const Scene<Dim> scene(seed);
    const Reference<Dim> reference(scene.surface.view(), scene.pairs, options.weighting);
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
    CHECK(result.pairs.size() > 5);
    CHECK(result.report.events > 5);
    CHECK(largest(as_column<Dim>(result.mean_correction.values()) - expected.head(n)) < 1e-11 * largest(expected.head(n)));
    CHECK(largest(as_column<Dim>(result.mean_gradient.values()) - expected.tail(n)) < 1e-11 * largest(expected.tail(n)));
}

TEMPLATE_TEST_CASE_SIG(
    "the work of the mean force is the change of the potential to round-off, for any way through any contact",
    "[contact][path]", ((int Dim), Dim), 2, 3) {
    ContactOptions options;
    options.weighting = GENERATE(InterfaceWeighting::stiffness, InterfaceWeighting::half);
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
        CHECK(once.pairs.size() > 200);
        CHECK(scene.energy_defect({}) < 1e-14);
        CHECK(as_column<Dim>(once.mean_gradient.values()) == as_column<Dim>(again.mean_gradient.values()));
        CHECK(as_column<Dim>(once.mean_correction.values()) == as_column<Dim>(again.mean_correction.values()));
        const VectorXd global = as_column<Dim>(scene.integral({}, Cuts::global).mean_gradient.values());
        CHECK(largest(as_column<Dim>(once.mean_gradient.values()) - global) < 1e-14 * largest(global));
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
        const VectorXd f = as_column<Dim>(global.mean_gradient.values());
        raise(worst, largest(as_column<Dim>(local.mean_gradient.values()) - f) / largest(f));
        CHECK(largest(as_column<Dim>(local.mean_correction.values()) - as_column<Dim>(global.mean_correction.values())) ==
              0.0);
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
        for (const Vector<Dim>& force : all.mean_gradient) {
            sum += force;
            size += force.norm();
        }
        CHECK(sum.norm() <= 1e-15 * size);
        for (const auto& pair : std::vector(scene.pairs)) {
            scene.pairs = {pair};
            const auto alone = scene.integral({});
            CHECK(alone.mean_gradient[contact::ListedFace{pair.first}] ==
                  -alone.mean_gradient[contact::ListedFace{pair.second}]);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("swapping the numbers of the two bodies leaves the forces on them as they are", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    for (int seed = 0; seed < 20; ++seed) {
        const Scene<Dim> scene(seed);
        auto swapped = scene;
        for (auto& [i, j] : swapped.pairs) std::swap(i, j);
        const VectorXd force = as_column<Dim>(scene.integral({}).mean_gradient.values());
        CHECK(largest(as_column<Dim>(swapped.integral({}).mean_gradient.values()) - force) < 1e-12 * largest(force));
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
    const auto list = scene.pair_list(InterfaceWeighting::stiffness);
    LawOnList<Dim> law({});
    auto memory = scene.memory();
    auto w_0 = as_vectors<Dim>(scene.host.r * scene.u_0), w_1 = as_vectors<Dim>(scene.host.r * scene.u_1);
    const auto y = as_vectors<Dim>(scene.host.free_force(scene.u_0));
    SECTION("apart") {
        for (std::int32_t f = 0; f < scene.surface.size(); ++f)
            if (scene.surface.body[f] == 1) w_0[f] += 5.0 * up<Dim>(), w_1[f] += 5.0 * up<Dim>();
    }
    SECTION("not admitted") { memory = scene.memory(false); }
    const auto& result = law(scene.surface.view(), list, memory, scene.faces, scene.host.coupling, {w_0, w_1, y, y});
    CHECK(result.pairs.empty());
    CHECK(result.report.events == 0);
    CHECK(result.report.compression == 0.0);
    CHECK(largest(as_column<Dim>(result.mean_correction.values())) == 0.0);
    CHECK(largest(as_column<Dim>(result.mean_gradient.values())) == 0.0);
}

TEMPLATE_TEST_CASE_SIG("what an instance has integrated before leaves no trace in its next result", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    const Scene<Dim> first(1), second(2);
    LawOnList<Dim> law({});
    contact::ContactStep<Dim> used;
    for (const Scene<Dim>* scene : {&first, &second}) {
        const auto w_0 = as_vectors<Dim>(scene->host.r * scene->u_0), w_1 = as_vectors<Dim>(scene->host.r * scene->u_1);
        const auto y_0 = as_vectors<Dim>(scene->host.free_force(scene->u_0)),
                   y_1 = as_vectors<Dim>(scene->host.free_force(scene->u_1));
        used = law(scene->surface.view(), scene->pair_list(InterfaceWeighting::stiffness), scene->memory(), scene->faces,
                   scene->host.coupling, {w_0, w_1, y_0, y_1});
    }
    const auto fresh = second.integral({});
    CHECK(as_column<Dim>(used.mean_gradient.values()) == as_column<Dim>(fresh.mean_gradient.values()));
    CHECK(as_column<Dim>(used.mean_correction.values()) == as_column<Dim>(fresh.mean_correction.values()));
    CHECK(used.report.events == fresh.report.events);
}

TEMPLATE_TEST_CASE_SIG("the energy of a step is what the corrections add to the host's potential at its end",
                       "[contact][path]", ((int Dim), Dim), 2, 3) {
    double worst = 0.0;
    for (int seed = 0; seed < 50; ++seed) {
        const Scene<Dim> scene(seed);
        const auto step = scene.integral({});
        const Reference<Dim> reference(scene.surface.view(), scene.pairs, InterfaceWeighting::stiffness);
        const auto corrections = reference.corrections(as_vectors<Dim>(scene.host.r * scene.u_1));
        const VectorXd delta = as_column<Dim>(std::span<const Vector<Dim>>(corrections));
        const double with = scene.host.potential(scene.u_1, delta);
        const double without = scene.host.potential(scene.u_1, VectorXd::Zero(delta.size()));
        raise(worst, std::abs(step.energy - (with - without)) / (std::abs(with) + std::abs(without)));
    }
    CHECK(worst < 1e-13);
}

TEMPLATE_TEST_CASE_SIG("the forces of the pairs of a step add up to the gradients and normal forces of its faces",
                       "[contact][path]", ((int Dim), Dim), 2, 3) {
    for (int seed = 0; seed < 20; ++seed) {
        const Scene<Dim> scene(seed);
        const auto step = scene.integral({});
        REQUIRE(step.pairs.size() > 3);
        std::vector<Vector<Dim>> gradient(step.faces.size(), Vector<Dim>::Zero());
        std::vector<double> normal_force(step.faces.size(), 0.0);
        double size = 0.0;
        for (const contact::PairStep<Dim>& pair : step.pairs) {
            const auto f_1 = static_cast<std::size_t>(pair.face_1), f_2 = static_cast<std::size_t>(pair.face_2);
            gradient[f_1] += pair.force;
            gradient[f_2] -= pair.force;
            normal_force[f_1] += pair.normal_force;
            normal_force[f_2] += pair.normal_force;
            size += pair.force.norm();
            // Of the force only what comes from sliding is not along the normal.
            CHECK(pair.force.dot(pair.normal) == Approx(pair.normal_force).margin(1e-13 * pair.force.norm()));
        }
        for (std::size_t f = 0; f < gradient.size(); ++f) {
            const contact::ListedFace face{static_cast<std::int32_t>(f)};
            CHECK((gradient[f] - step.mean_gradient[face]).norm() <= 1e-14 * size);
            CHECK(std::abs(normal_force[f] - step.mean_normal_force[face]) <= 1e-14 * size);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("gaps, area, share and compression of a pair are those of its motion through the step",
                       "[contact][path]", ((int Dim), Dim), 2, 3) {
    // A unit tile sinks from 0.1 above another one to 0.3 into it, and slides from s = 0.2 to 0.6: it closes at tau = 1/4.
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.25, 1.0, 0);
    surface.append(tile<Dim>(Vector<Dim>::Zero(), -up<Dim>(), 0.5), 0.25, 1.0, 1);
    contact::PairList<Dim> list;
    list.append(surface.view(), 0, 1, InterfaceWeighting::half);
    const std::vector<contact::Face> faces{contact::Face{0}, contact::Face{1}};
    list.number_faces(faces);
    const std::vector<Vector<Dim>> u_0{Vector<Dim>::Zero(), 0.1 * up<Dim>() + 0.2 * axis<Dim>(0)};
    const std::vector<Vector<Dim>> u_1{Vector<Dim>::Zero(), -0.3 * up<Dim>() + 0.6 * axis<Dim>(0)};
    const std::vector<Vector<Dim>> y(2, Vector<Dim>::Zero());
    LawOnList<Dim> law({});
    const auto& step = law(surface.view(), list, {{.admitted = true}}, faces, uncoupled<Dim>(2), {u_0, u_1, y, y});
    REQUIRE(step.pairs.size() == 1);
    const contact::PairStep<Dim>& pair = step.pairs.front();
    CHECK(pair.gap_0 == Approx(0.1).epsilon(1e-14));
    CHECK(pair.gap_1 == Approx(-0.3).epsilon(1e-14));
    CHECK(pair.active_share == Approx(0.75).epsilon(1e-14));
    CHECK(pair.area == Approx(0.75 * (0.7 + 0.4) / 2.0).epsilon(1e-14));  // 1 - s falls from 0.7 to 0.4 while it is closed
    CHECK(pair.compression == Approx(0.6).epsilon(1e-14));
    CHECK(pair.events == 1);
    CHECK(step.report.most_compressed == 0);
}
