// Loads that a program outside sets, of which each rank gives those on its own faces.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/outside_view.hpp"
#include "ranks/shared_solid.hpp"
#include "ranks/solid_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using dynamics::StepChange;
using solid::Kinematics;
using solid::LoadImpulse;

namespace {

/// A long side that several ranks share, and an end that some have no face of.
constexpr std::array groups{"upper.ymax", "lower.xmin"};

/// A bar falls onto another one.
template <int Dim>
mesh::Mesh<Dim> two_bars() {
    Vector<Dim> corner = Vector<Dim>::Constant(0.3), other = corner, lower = Vector<Dim>::Zero();
    std::array<int, Dim> n, n_other;
    n.fill(Dim == 2 ? 4 : 3), n_other.fill(Dim == 2 ? 3 : 2);
    corner[0] = 4.0, other[0] = 3.6;
    n[0] = Dim == 2 ? 56 : 24, n_other[0] = Dim == 2 ? 44 : 19;
    lower[0] = 0.17, lower[1] = 0.302;
    const auto shape = Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron;
    std::vector<mesh::Mesh<Dim>> bars{mesh::structured_box<Dim>(Vector<Dim>::Zero(), corner, n, shape, "lower"),
                                      mesh::structured_box<Dim>(lower, lower + other, n_other, shape, "upper")};
    return mesh::combine<Dim>(bars);
}

template <int Dim>
mesh::Mesh<Dim> two_grains() {
    Vector<Dim> corner = Vector<Dim>::Constant(0.5), lower = Vector<Dim>::Zero();
    std::array<int, Dim> n;
    n.fill(Dim == 2 ? 6 : 3);
    corner[0] = 2.0, n[0] = Dim == 2 ? 24 : 12;
    lower[0] = 2.0;
    const auto shape = Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron;
    std::vector<mesh::Mesh<Dim>> grains{mesh::structured_box<Dim>(Vector<Dim>::Zero(), corner, n, shape, "left"),
                                        mesh::structured_box<Dim>(lower, lower + corner, n, shape, "right")};
    return mesh::combine<Dim>(grains);
}

template <int Dim>
solid::SolidOptions<Dim> loaded_from_outside(Kinematics kinematics) {
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.kinematics.assign(2, kinematics);
    options.contact = contact::ContactOptions{};
    options.law = solid::ContactLaw::pair_potential;
    options.friction.coefficient = 0.2;
    for (const char* group : groups) options.boundary.traction.push_back({.group = group, .from_outside = true});
    return options;
}

template <int Dim>
std::vector<Vector<Dim>> falling() {
    return {Vector<Dim>::Zero(), Vector<Dim>(-0.04 * Vector<Dim>::Unit(1))};
}

/// A wave along a group, on which faces answer to how far they move in a step: each rank knows its own motions alone.
template <int Dim>
std::vector<Vector<Dim>> answers(const solid::OutsideFaces<Dim>& faces, const std::vector<Vector<Dim>>& motion, double dt) {
    std::vector<Vector<Dim>> traction;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const Vector<Dim> wave = 2e-3 * std::sin(0.3 * faces.number[i] + 40.0 * faces.position[i][0]) * faces.normal[i];
        traction.push_back(wave - 0.02 / dt * motion[i]);
    }
    return traction;
}

/// Values of these faces among those by number.
template <class Value>
std::vector<Value> of_faces(const std::vector<std::int32_t>& numbers, const std::vector<Value>& of_all) {
    std::vector<Value> values;
    for (const std::int32_t number : numbers) values.push_back(of_all[static_cast<std::size_t>(number)]);
    return values;
}

template <class Value>
bool same(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

/// Whether this rank sees its faces as one rank sees them.
template <int Dim>
bool same_faces(const solid::OutsideFaces<Dim>& of_alone, const solid::OutsideFaces<Dim>& here) {
    return same(of_faces(here.number, of_alone.position), here.position) &&
           same(of_faces(here.number, of_alone.velocity), here.velocity) &&
           same(of_faces(here.number, of_alone.normal), here.normal) &&
           same(of_faces(here.number, of_alone.area), here.area) &&
           same(of_faces(here.number, of_alone.bonded), here.bonded) &&
           same(of_faces(here.number, of_alone.traction), here.traction);
}

/// A run on one rank, and the same shared out to all.
template <int Dim>
struct BothRuns {
    const ranks::Communicator all = world();
    mesh::Mesh<Dim> mesh = two_bars<Dim>();
    ClockedPart<Dim> alone, shared;

    explicit BothRuns(Kinematics kinematics, LoadImpulse impulse = LoadImpulse::as_given)
        : alone(mesh, loaded_from_outside<Dim>(kinematics), falling<Dim>(), impulse),
          shared(all, mesh, loaded_from_outside<Dim>(kinematics), parts(all, mesh), falling<Dim>(), impulse) {}

    [[nodiscard]] double dt() const { return alone.run.memm().dt(); }

    /// A step that the program outside dictates.
    void step(double dt, StepChange change) {
        const auto set = [&](ClockedPart<Dim>& one, const char* group) {
            auto& memm = one.run.memm();
            const auto faces = solid::outside_faces<Dim>(memm, one.run.solid(), group);
            const auto motion = one.run.solid().outside(group).motion(memm.q(), memm.next_q(), memm.time(), dt);
            one.run.solid().set_traction(group, answers<Dim>(faces, motion, dt));
            return std::pair(faces, motion);
        };
        static_cast<void>(alone.run.set_step(dt, change));
        static_cast<void>(shared.run.set_step(dt, change));
        for (const char* group : groups) {
            const auto [faces, motion] = set(alone, group);
            const auto [here, motion_here] = set(shared, group);
            const bool moves_alike = same(of_faces(here.number, motion), motion_here);
            REQUIRE(everywhere(all, same_faces<Dim>(faces, here) && moves_alike));
        }
        alone.run.step();
        shared.run.step();
        check();
    }

    /// A time that it dictates.
    void advance(double d) {
        for (const char* group : groups) {
            const auto faces = alone.clock.faces(group), here = shared.clock.faces(group);
            const auto motion = alone.clock.motion(group, d), motion_here = shared.clock.motion(group, d);
            const bool moves_alike = same(of_faces(here.number, motion), motion_here);
            REQUIRE(everywhere(all, same_faces<Dim>(faces, here) && moves_alike));
            alone.clock.set_traction(group, answers<Dim>(faces, motion, d));
            shared.clock.set_traction(group, answers<Dim>(here, motion_here, d));
        }
        alone.clock.advance(d);
        shared.clock.advance(d);
        check();
    }

    void check() {
        CAPTURE(all.rank(), alone.run.memm().steps());
        REQUIRE(everywhere(all, test::same_bits(shared.own(alone.clock.q()), shared.clock.q())));
        REQUIRE(everywhere(all, test::same_bits(shared.own(alone.run.memm().p_after()), shared.run.memm().p_after())));
        const solid::OutsideWork of_alone = alone.run.solid().outside_work(alone.run.memm().q()),
                                 here = shared.run.solid().outside_work(shared.run.memm().q());
        REQUIRE(everywhere(all, of_alone.steps == here.steps && of_alone.changes == here.changes &&
                                    of_alone.held == here.held && of_alone.heat == here.heat));
    }

    /// All that is recorded and saved; they have acted, and the bars have met.
    void check_end() {
        const auto entry = [](ClockedPart<Dim>& one) {
            return dynamics::ledger_values(dynamics::measure(one.run.memm(), one.run.solid(), one.run.restarts()));
        };
        CHECK(same(entry(alone), entry(shared)));
        CHECK(alone.run.solid().state() == shared.run.solid().state());
        CHECK(alone.run.solid().outside_work(alone.run.memm().q()).steps != 0.0);
        CHECK(alone.run.solid().contact().report().active_pairs_max > 0);
    }
};

Kinematics any_kinematics() {
    return GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid);
}

}  // namespace

/// What bonds hold is loaded, too, and the cells beside it: a bar of two grains that are pulled apart.
TEMPLATE_TEST_CASE_SIG("faces that cracks leave bare have the bits of one rank, and so does what loads them",
                       "[ranks][outside][fracture]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = world();
    const Kinematics kinematics = GENERATE(Kinematics::floating, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    const std::array<std::string, 4> sides{"left.xmax", "right.xmin", "left.ymin", "right.xmax"};
    const mesh::Mesh<Dim> mesh = two_grains<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials.assign(2, {.young = 1.0, .poisson = 0.2, .density = 1.0});
    options.kinematics.assign(2, kinematics);
    options.contact = contact::ContactOptions{};
    options.bonds = {{.sides = {0, 1}, .strength = 2e-3, .fracture_energy = 1e-6, .of_grains = true}};
    for (const std::string& side : sides) options.boundary.traction.push_back({.group = side, .from_outside = true});
    const std::vector<Vector<Dim>> velocity{Vector<Dim>::Zero(), Vector<Dim>(1e-2 * Vector<Dim>::Unit(0))};
    ClockedPart<Dim> alone(mesh, options, velocity, LoadImpulse::as_given),
        shared(all, mesh, options, parts(all, mesh), velocity, LoadImpulse::as_given);
    bool was_bonded = false, is_bare = false;
    for (int i = 0; i < 200; ++i) {
        for (const std::string& side : sides) {
            const auto faces = alone.clock.faces(side), here = shared.clock.faces(side);
            REQUIRE(everywhere(all, same_faces<Dim>(faces, here)));
            if (side == sides[0]) {
                was_bonded = was_bonded || std::ranges::all_of(faces.bonded, [](double share) { return share > 0.99; });
                is_bare = std::ranges::all_of(faces.bonded, [](double share) { return share == 0.0; });
            }
            const auto load = [](const solid::OutsideFaces<Dim>& of) {
                std::vector<Vector<Dim>> traction;
                for (std::size_t f = 0; f < of.number.size(); ++f)
                    traction.push_back(-1e-3 * (1.0 - of.bonded[f]) * (1.0 + 0.1 * of.number[f]) * of.normal[f]);
                return traction;
            };
            alone.clock.set_traction(side, load(faces));
            shared.clock.set_traction(side, load(here));
        }
        alone.clock.advance(alone.clock.time_to_node());
        shared.clock.advance(shared.clock.time_to_node());
        REQUIRE(everywhere(all, test::same_bits(shared.own(alone.clock.q()), shared.clock.q())));
    }
    CHECK(was_bonded);
    CHECK(is_bare);
    CHECK(alone.run.solid().state() == shared.run.solid().state());
}

TEMPLATE_TEST_CASE_SIG("each face of a group that is loaded from outside is on one rank, with its number of one rank",
                       "[ranks][solid][outside]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = world();
    const auto mesh = two_bars<Dim>();
    auto options = loaded_from_outside<Dim>(Kinematics::small);
    options.kinematics[1] = GENERATE(Kinematics::small, Kinematics::rigid);
    SharedSolid<Dim> shared(all, mesh, options, parts(all, mesh));
    for (const char* group : groups) {
        const solid::OutsideView<Dim> here = shared.solid.outside(group);
        const std::vector<std::int32_t>& faces = mesh.group(group).faces;
        REQUIRE(here.n_all() == faces.size());
        std::vector<double> x;
        for (const std::int32_t face : here.faces()) x.push_back(shared.part.mesh.face_centroid[face][0]);
        std::vector<double> x_of_whole;
        for (const std::int32_t face : faces) x_of_whole.push_back(mesh.face_centroid[face][0]);
        CHECK(here.gather(x) == x_of_whole);
        std::vector<double> numbers(here.numbers().begin(), here.numbers().end());
        numbers = here.gather(numbers);
        for (std::size_t i = 0; i < numbers.size(); ++i) CHECK(numbers[i] == static_cast<double>(i));
    }
}

TEMPLATE_TEST_CASE_SIG("under loads from outside steps that are dictated have the bits of one rank, and the same works",
                       "[ranks][solid][outside]", ((int Dim), Dim), 2, 3) {
    BothRuns<Dim> runs(any_kinematics());
    const double dt = runs.dt();
    for (int i = 0; i < (Dim == 2 ? 40 : 12); ++i)
        runs.step((1.0 - 0.05 * (i % 3)) * dt, i % 2 == 0 ? StepChange::keep : StepChange::restart);
    runs.check_end();
}

TEMPLATE_TEST_CASE_SIG("under loads from outside dictated times have the bits of one rank, and the same works",
                       "[ranks][solid][outside][clock]", ((int Dim), Dim), 2, 3) {
    const LoadImpulse impulse = GENERATE(LoadImpulse::as_given, LoadImpulse::trapezoid);
    BothRuns<Dim> runs(any_kinematics(), impulse);
    for (int i = 0; i < (Dim == 2 ? 80 : 24); ++i)
        runs.advance(std::min((0.2 + 0.37 * (i % 3)) * runs.dt(), runs.alone.clock.time_to_node()));
    runs.check_end();
}

TEST_CASE("a state of one rank under loads from outside goes on with the same bits on several, and theirs on one",
          "[ranks][solid][outside][clock]") {
    const LoadImpulse impulse = GENERATE(LoadImpulse::as_given, LoadImpulse::trapezoid);
    BothRuns<2> runs(any_kinematics(), impulse);
    const auto go_on = [&](int n) {
        for (int i = 0; i < n; ++i) runs.advance(std::min(0.7 * runs.dt(), runs.alone.clock.time_to_node()));
    };
    go_on(20);
    const auto of_alone = runs.alone.clock.state(), of_shared = runs.shared.clock.state();
    CHECK(of_alone.loads == of_shared.loads);
    CHECK(of_alone.run.solid == of_shared.run.solid);
    go_on(10);
    runs.shared.clock.restore(of_alone);
    runs.alone.clock.restore(of_shared);
    runs.check();
    go_on(25);
    runs.check_end();
}

TEST_CASE("tractions that one rank gives wrongly are refused on all of them, and nothing changes",
          "[ranks][solid][outside][errors]") {
    BothRuns<2> runs(Kinematics::small);
    solid::Solid<2>& solid = runs.shared.run.solid();
    runs.step(runs.dt(), StepChange::keep);
    const auto n = static_cast<std::size_t>(solid.outside(groups[0]).faces().size());
    const double first_with_faces = -runs.all.largest(n > 0 ? -runs.all.rank() : -runs.all.size());
    const bool is_wrong = runs.all.rank() == first_with_faces;
    std::vector<Vector<2>> wrong(n, Vector<2>::Ones());
    if (is_wrong) wrong.emplace_back();
    CHECK_THROWS_WITH(solid.set_traction(groups[0], wrong), Contains("upper.ymax") && Contains("faces. Give one per face"));
    CHECK_THROWS_WITH(solid.set_traction("upper.xmin", wrong), Contains("no traction from outside acts on 'upper.xmin'"));
    CHECK_THROWS_WITH(solid.outside(groups[0]).gather(wrong), Contains("upper.ymax") && Contains("that this rank has"));
    wrong.assign(n, Vector<2>::Ones());
    if (is_wrong) wrong.back()[1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(solid.set_traction(groups[0], wrong), Contains("upper.ymax") && Contains("is not finite"));
    if (runs.all.size() > 1) {
        const char* group = groups[static_cast<std::size_t>(runs.all.rank() % 2)];
        wrong.assign(solid.outside(group).faces().size(), Vector<2>::Ones());
        CHECK_THROWS_WITH(solid.set_traction(group, wrong), Contains("Give the same group on all of them"));
        CHECK_THROWS_WITH(runs.shared.clock.motion(groups[0], (0.1 + 0.1 * runs.all.rank()) * runs.dt()),
                          Contains("Give the same on all of them"));
    }
    auto state = runs.shared.clock.state();
    if (is_wrong) state.loads.pop_back();
    CHECK_THROWS_WITH(runs.shared.clock.restore(state), Contains("other groups or faces"));
    for (int i = 0; i < 5; ++i) runs.step(runs.dt(), StepChange::keep);
}
