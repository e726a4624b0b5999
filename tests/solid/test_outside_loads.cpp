// Tractions that a program outside sets between steps, and the faces that it follows.
#include <catch2/catch.hpp>

#include "abut/dynamics/leapfrog.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/outside_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using dynamics::StepChange;
using solid::Kinematics;

namespace {

constexpr const char* loaded = "upper.xmax";

/// Two blocks that fall onto each other, the upper one loaded from outside at its side.
template <int Dim>
mesh::Mesh<Dim> blocks() {
    Vector<Dim> upper = Vector<Dim>::Ones();
    upper[Dim - 1] = 0.5;
    Vector<Dim> other_lower = Vector<Dim>::Constant(0.1), other_upper = Vector<Dim>::Constant(0.83);
    other_lower[Dim - 1] = 0.505;
    other_upper[Dim - 1] = 1.2;
    return together(
        mesh::box<Dim>({.lower = Vector<Dim>::Zero(), .upper = upper, .size = Dim == 2 ? 0.2 : 0.35, .name = "lower"}),
        mesh::box<Dim>({.lower = other_lower, .upper = other_upper, .size = Dim == 2 ? 0.15 : 0.3, .name = "upper"}));
}

template <int Dim>
solid::SolidOptions<Dim> blocks_loaded_from_outside() {
    auto options = bodies<Dim>(2);
    options.boundary.traction = {{.group = loaded, .from_outside = true}};
    return options;
}

template <int Dim>
std::vector<Vector<Dim>> falling() {
    return {Vector<Dim>::Zero(), Vector<Dim>(-0.05 * Vector<Dim>::Unit(Dim - 1))};
}

template <int Dim>
std::vector<Vector<Dim>> random_tractions(std::size_t n, unsigned seed) {
    const std::vector<double> numbers = random_state(Dim * n, seed, 0.01);
    return {vectors<Dim>(numbers).begin(), vectors<Dim>(numbers).end()};
}

/// Sum of |f| t . motion.
template <int Dim>
double work_of(const solid::OutsideFaces<Dim>& faces, const std::vector<Vector<Dim>>& motion) {
    double work = 0.0;
    for (std::size_t i = 0; i < motion.size(); ++i) work += faces.area[i] * faces.traction[i].dot(motion[i]);
    return work;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("tractions set by face before each step have the bits of a condition with that history",
                       "[solid][outside]", ((int Dim), Dim), 2, 3) {
    const auto load = [](double t, const Vector<Dim>& x) {
        return Vector<Dim>(0.01 * std::sin(5.0 * t) * (1.0 + x[1]) * Vector<Dim>::Ones());
    };
    auto with_history = bodies<Dim>(2);
    with_history.boundary.traction = {{.group = loaded, .history = load}};
    Scene<Dim> expected(blocks<Dim>(), with_history, falling<Dim>());
    Scene<Dim> scene(blocks<Dim>(), blocks_loaded_from_outside<Dim>(), falling<Dim>());
    for (int i = 0; i < 100; ++i) {
        std::vector<Vector<Dim>> traction;
        for (const std::int32_t face : scene.mesh.group(loaded).faces)
            traction.push_back(load(scene.memm.time(), scene.mesh.face_centroid[face]));
        scene.solid.set_traction(loaded, traction);
        scene.memm.step();
        expected.memm.step();
    }
    CHECK(std::ranges::equal(scene.memm.q(), expected.memm.q()));
    CHECK(std::ranges::equal(scene.memm.p_after(), expected.memm.p_after()));
    CHECK(scene.solid.work() == expected.solid.work());
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
}

TEMPLATE_TEST_CASE_SIG(
    "what tractions from outside give is |f| t . motion of the faces, and what half-cells take in at once",
    "[solid][outside]", ((int Dim), Dim), 2, 3) {
    auto options = blocks_loaded_from_outside<Dim>();
    options.boundary.free_face_rule = GENERATE(solid::FreeFaceRule::local_equilibrium, solid::FreeFaceRule::extrapolate);
    Scene<Dim> scene(blocks<Dim>(), options, falling<Dim>());
    const double start = scene.memm.pseudo_energy();
    double steps = 0.0, largest_defect = 0.0, energy = start;
    for (unsigned i = 0; i < 150; ++i) {
        const auto before = solid::outside_faces<Dim>(scene.memm, scene.solid, loaded);
        if (i % 3 != 2) scene.solid.set_traction(loaded, random_tractions<Dim>(before.area.size(), i));
        const auto motion = scene.solid.outside(loaded).motion(scene.memm.q(), scene.memm.next_q(), scene.memm.time(),
                                                               scene.memm.dt());  // known before the step
        scene.memm.step();
        const auto faces = solid::outside_faces<Dim>(scene.memm, scene.solid, loaded);
        steps += work_of(faces, motion);
        if (i % 3 == 2)
            for (std::size_t k = 0; k < motion.size(); ++k)
                CHECK((faces.position[k] - before.position[k] - motion[k]).norm() < 1e-15);

        const solid::OutsideWork work = scene.solid.outside_work(scene.memm.q());
        double held = 0.0;
        for (std::size_t k = 0; k < faces.area.size(); ++k)
            held += faces.area[k] *
                    faces.traction[k].dot(faces.position[k] - scene.mesh.face_centroid[scene.mesh.group(loaded).faces[k]]);
        CHECK(std::abs(work.held - held) < 1e-15);
        const double of_bodies = scene.memm.pseudo_energy() + work.held;
        raise(energy, of_bodies);
        raise(largest_defect, std::abs(of_bodies - start - work.steps - work.changes));
    }
    const solid::OutsideWork work = scene.solid.outside_work(scene.memm.q());
    CHECK(work.steps == Approx(steps).epsilon(1e-12));
    CHECK(largest_defect < 1e-12 * energy);
    CHECK(std::abs(work.steps) > 1e-3 * energy);
    if (options.boundary.free_face_rule == solid::FreeFaceRule::extrapolate)
        CHECK(std::abs(work.changes) < 1e-14 * energy);  // its faces do not give way
    else
        CHECK(work.changes > 1e-4 * energy);
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("heat beside tractions from outside has an account of its own, of bodies of each kinematics",
                       "[solid][outside][thermal]", ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    const bool sets = GENERATE(true, false);  // tractions at most steps, or none after the start
    CAPTURE(static_cast<int>(kinematics), sets);
    auto options = blocks_loaded_from_outside<Dim>();
    options.law = solid::ContactLaw::pair_potential;
    options.kinematics.assign(2, kinematics);
    for (solid::Material& material : options.materials) material.expansion.along_1 = 1e-3;
    for (const double amplitude : {30.0, -20.0})
        options.temperature_rise.push_back(
            {.value = [amplitude](double t, const Vector<Dim>& x) { return amplitude * (std::sin(3.0 * t) + 0.4 * x[0]); },
             .varies = true});
    Scene<Dim> scene(blocks<Dim>(), options, falling<Dim>());
    const double start = scene.memm.pseudo_energy();
    double steps = 0.0, first = 0.0, energy = start, apart = 0.0, all = 0.0;
    auto faces = solid::outside_faces<Dim>(scene.memm, scene.solid, loaded);
    for (unsigned i = 0; i < 100; ++i) {
        if ((sets && i % 3 != 2) || i == 0) scene.solid.set_traction(loaded, random_tractions<Dim>(faces.area.size(), i));
        scene.memm.step();
        const auto before = std::move(faces);
        faces = solid::outside_faces<Dim>(scene.memm, scene.solid, loaded);
        std::vector<Vector<Dim>> motion;  // with what heat does to faces where the step begins
        for (std::size_t k = 0; k < faces.position.size(); ++k) motion.push_back(faces.position[k] - before.position[k]);
        const solid::OutsideWork work = scene.solid.outside_work(scene.memm.q());
        if (i == 0)
            first = work.steps;  // the half-cells have given way to the load
        else
            steps += work_of(faces, motion);
        const double now = scene.memm.pseudo_energy();
        raise(energy, std::abs(now + work.held));
        raise(apart, std::abs(now + work.held - start - work.steps - work.changes - work.heat));
        raise(all, std::abs(now - start - scene.solid.work()));
    }
    const solid::OutsideWork work = scene.solid.outside_work(scene.memm.q());
    CHECK(apart <= 1e-12 * energy);
    CHECK(all <= 1e-12 * energy);
    CHECK(std::abs(work.heat) > 1e-3 * energy);
    // What the program outside sees of its faces is what it is told that it has done.
    if (!sets) CHECK(work.steps - first == Approx(steps).epsilon(1e-10).margin(1e-14));
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}

TEST_CASE("heat has the same account whether tractions from outside are set with it or stay", "[solid][outside][thermal]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    const auto work = [&](double change) {  // of the load, relative, at each step
        auto options = blocks_loaded_from_outside<2>();
        options.contact.reset();
        options.kinematics.assign(2, kinematics);
        for (solid::Material& material : options.materials) material.expansion.along_1 = 1e-3;
        options.temperature_rise.assign(
            2, {.value = [](double t, const Vector<2>&) { return 30.0 * std::sin(3.0 * t); }, .varies = true});
        Scene<2> scene(blocks<2>(), options, falling<2>());
        const std::size_t n = scene.mesh.group(loaded).faces.size();
        for (int i = 0; i < 50; ++i) {
            scene.solid.set_traction(loaded, std::vector<Vector<2>>(n, (1.0 + i * change) * Vector<2>(0.01, 0.02)));
            scene.memm.step();
        }
        return scene.solid.outside_work(scene.memm.q());
    };
    const solid::OutsideWork stays = work(0.0), set = work(1e-12);
    CHECK(std::abs(stays.heat) > 1e-5);
    CHECK(set.heat == Approx(stays.heat).epsilon(1e-8));
    CHECK(set.steps == Approx(stays.steps).epsilon(1e-8));
    CHECK(set.changes == Approx(stays.changes).epsilon(1e-8).margin(1e-14));
}

TEMPLATE_TEST_CASE_SIG("a step dictated from outside with restarts books the same work, and restarts what they change",
                       "[solid][outside]", ((int Dim), Dim), 2, 3) {
    Scene<Dim> scene(blocks<Dim>(), blocks_loaded_from_outside<Dim>(), falling<Dim>());
    const auto policy = GENERATE(StepChange::restart, StepChange::keep);
    const double stable = scene.memm.dt(), start = scene.memm.pseudo_energy();
    const auto factors = random_state(60, 8, 0.25);
    double steps = 0.0, energy = start, defect = 0.0;
    for (unsigned i = 0; i < factors.size(); ++i) {
        const double dt = (0.75 + factors[i]) * stable;
        scene.memm.set_step(dt, policy);
        scene.solid.set_traction(loaded, random_tractions<Dim>(scene.mesh.group(loaded).faces.size(), i));
        const auto motion =
            scene.solid.outside(loaded).motion(scene.memm.q(), scene.memm.next_q(), scene.memm.time(), scene.memm.dt());
        scene.memm.step();
        steps += work_of(solid::outside_faces<Dim>(scene.memm, scene.solid, loaded), motion);
        const solid::OutsideWork work = scene.solid.outside_work(scene.memm.q());
        const double of_bodies = scene.memm.pseudo_energy() + work.held;
        raise(energy, of_bodies);
        raise(defect, std::abs(of_bodies - start - work.steps - work.changes - scene.memm.restart_jumps()));
    }
    CHECK(scene.solid.outside_work(scene.memm.q()).steps == Approx(steps).epsilon(1e-12));
    CHECK(defect < 1e-12 * energy);
    CHECK((scene.memm.restart_jumps() != 0.0) == (policy == StepChange::restart));
}

TEMPLATE_TEST_CASE_SIG("faces move with the velocities of their cells: over a step with those of its half-step momenta",
                       "[solid][outside]", ((int Dim), Dim), 2, 3) {
    Scene<Dim> scene(blocks<Dim>(), blocks_loaded_from_outside<Dim>(), falling<Dim>());
    scene.solid.set_traction(loaded, random_tractions<Dim>(scene.mesh.group(loaded).faces.size(), 1));
    for (int i = 0; i < 20; ++i) scene.memm.step();
    const auto velocity = scene.solid.outside(loaded).velocity(scene.memm.p_after());
    const auto motion =
        scene.solid.outside(loaded).motion(scene.memm.q(), scene.memm.next_q(), scene.memm.time(), scene.memm.dt());
    const auto faces = solid::outside_faces<Dim>(scene.memm, scene.solid, loaded);
    double fastest = 0.0;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        CHECK((scene.memm.dt() * velocity[i] - motion[i]).norm() < 1e-15);
        CHECK(faces.normal[i] == scene.mesh.face_normal[scene.mesh.group(loaded).faces[i]]);
        raise(fastest, faces.velocity[i].norm());
    }
    CHECK(fastest > 1e-3);
}

TEMPLATE_TEST_CASE_SIG("of bodies that turn the work is booked as work, and normals turn", "[solid][outside]",
                       ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::rigid, Kinematics::floating, Kinematics::finite);
    const bool follows = kinematics != Kinematics::finite && GENERATE(false, true);
    auto options = bodies<Dim>(1);
    options.contact.reset();
    options.boundary.traction = {{.group = "xmin", .follows = follows, .from_outside = true}};
    std::array<int, Dim> counts;
    counts.fill(3);
    const auto mesh = mesh::structured_box<Dim>(-Vector<Dim>::Constant(0.5), Vector<Dim>::Constant(0.5), counts,
                                                Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
    const double spin = 0.1;
    AxialVector<Dim> about_last = AxialVector<Dim>::Zero();
    about_last[about_last.size() - 1] = spin;
    TurningScene<Dim> scene(mesh, options, {moving<Dim>(Vector<Dim>::Zero(), about_last)}, -0.05, kinematics);
    const double start = scene.memm.pseudo_energy();
    double steps = 0.0, defect = 0.0, sum = 0.0;  // there and back: sum of what has no sign
    for (unsigned i = 0; i < 100; ++i) {
        scene.solid.set_traction("xmin",
                                 std::vector<Vector<Dim>>(mesh.group("xmin").faces.size(),
                                                          Vector<Dim>(1e-5 * std::cos(0.1 * i) * Vector<Dim>::Ones())));
        const auto motion =
            scene.solid.outside("xmin").motion(scene.memm.q(), scene.memm.next_q(), scene.memm.time(), scene.memm.dt());
        scene.memm.step();
        const auto faces = solid::outside_faces<Dim>(scene.memm, scene.solid, "xmin");
        if (!follows) steps += work_of(faces, motion);
        sum += std::abs(work_of(faces, motion));
        raise(defect, std::abs(scene.memm.pseudo_energy() - start - scene.solid.outside_work(scene.memm.q()).steps));
    }
    const solid::OutsideWork work = scene.solid.outside_work(scene.memm.q());
    if (!follows) CHECK(std::abs(work.steps - steps) <= 1e-12 * sum);
    CHECK(std::abs(work.steps - scene.solid.work()) <= 1e-12 * sum);
    CHECK(work.steps != 0.0);
    CHECK(work.held == 0.0);
    CHECK(work.changes == 0.0);
    CHECK(defect < 1e-12 * start);
    const double angle = spin * scene.memm.time();
    const Vector<Dim> normal = solid::outside_faces<Dim>(scene.memm, scene.solid, "xmin").normal[0];
    if (kinematics != Kinematics::finite) {
        CHECK(normal[0] == Approx(-std::cos(angle)).epsilon(1e-3));
        CHECK(normal[1] == Approx(-std::sin(angle)).margin(1e-3));
    }
}

TEST_CASE("leapfrog takes tractions from outside, those of a history with the same bits", "[solid][outside]") {
    const auto mesh = blocks<2>();
    auto with_history = bodies<2>(2);
    with_history.boundary.traction = {
        {.group = loaded, .history = [](double t, const Vector<2>&) { return Vector<2>(0.01 * std::sin(5.0 * t), 0.0); }}};
    solid::Solid<2> expected(mesh, with_history), solid(mesh, blocks_loaded_from_outside<2>());
    const auto momentum = solid::uniform_momentum<2>(solid, falling<2>());
    const std::vector<double> rest(solid.size(), 0.0);
    const double dt = 0.9 * dynamics::stable_step(solid).dt;
    dynamics::Leapfrog history(expected, rest, momentum, dt), leapfrog(solid, rest, momentum, dt);
    for (int i = 0; i < 50; ++i) {
        const Vector<2> traction(0.01 * std::sin(5.0 * leapfrog.time()), 0.0);
        solid.set_traction(loaded, std::vector<Vector<2>>(mesh.group(loaded).faces.size(), traction));
        leapfrog.step();
        history.step();
    }
    CHECK(std::ranges::equal(leapfrog.q(), history.q()));
}

TEST_CASE("tractions from outside that cannot be are refused by the name of their group, and nothing changes",
          "[solid][outside][errors]") {
    Scene<2> scene(blocks<2>(), blocks_loaded_from_outside<2>(), falling<2>());
    const auto n = scene.mesh.group(loaded).faces.size();
    const auto good = random_tractions<2>(n, 1);
    scene.solid.set_traction(loaded, good);
    auto bad = good;
    bad[1].y() = std::nan("");
    CHECK_THROWS_WITH(scene.solid.set_traction(loaded, bad),
                      Contains(loaded) && Contains("face 1") && Contains("not finite"));
    bad.pop_back();
    CHECK_THROWS_WITH(scene.solid.set_traction(loaded, bad),
                      Contains(std::to_string(n - 1) + " are given for " + std::to_string(n) + " faces"));
    CHECK_THROWS_WITH(scene.solid.set_traction("lower.xmin", good), Contains("'lower.xmin'") && Contains(loaded));
    CHECK_THROWS_AS(scene.solid.set_traction("nowhere", good), BadInput);
    CHECK_THROWS_AS(solid::outside_faces<2>(scene.memm, scene.solid, "lower.xmin"), BadInput);
    CHECK(std::ranges::equal(scene.solid.outside(loaded).traction(), good));
}

TEST_CASE("conditions from outside that cannot be are refused", "[solid][outside][errors]") {
    const auto mesh = blocks<2>();
    auto options = blocks_loaded_from_outside<2>();
    std::string says = loaded;
    SECTION("with a history") {
        options.boundary.traction[0].history = [](double, const Vector<2>&) { return Vector<2>::Zero(); };
        says = "history";
    }
    SECTION("twice") {
        options.boundary.traction.push_back(options.boundary.traction[0]);
        says = "twice";
    }
    SECTION("not finite at the start") {
        options.boundary.traction[0].value.x() = std::nan("");
        says = "not finite";
    }
    SECTION("an unknown group") {
        options.boundary.traction[0].group = "nowhere";
        says = "nowhere";
    }
    SECTION("where all is prescribed") { options.boundary.dirichlet = {{.group = loaded}}; }
    SECTION("that follows a body of Kinematics::finite") {
        options.kinematics = {Kinematics::small, Kinematics::finite};
        options.boundary.traction[0].follows = true;
        says = "follows";
    }
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains(says));
    CHECK_THROWS_AS(solid::Solid<2>(mesh, options), BadInput);
}

TEST_CASE("local time steps refuse tractions from outside", "[solid][outside][errors]") {
    const auto mesh = blocks<2>();
    auto options = blocks_loaded_from_outside<2>();
    options.law = solid::ContactLaw::reconstruction;
    solid::Solid<2> solid(mesh, options);
    CHECK_THROWS_WITH(solid.set_levels(1, std::vector<std::int32_t>(solid.size(), 0)), Contains("from outside"));
}
