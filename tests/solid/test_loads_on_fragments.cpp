// Tractions that a program outside sets on bodies that break, and on the faces that come to be free.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/outside_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using solid::Kinematics;

namespace {

const std::vector<std::string> wet = {"left.ymin", "right.ymin"};    // sides along the bar, with cells that are bonded, too
const std::vector<std::string> crack = {"left.xmax", "right.xmin"};  // what bonds hold
const std::vector<std::string> ends = {"left.xmin", "right.xmax"};

/// A bar of two grains: triangles and quadrangles, tetrahedra and hexahedra.
template <int Dim>
mesh::Mesh<Dim> bar(bool simplices) {
    Vector<Dim> lower = Vector<Dim>::Zero(), middle = Vector<Dim>::Constant(0.6), upper = middle;
    middle[0] = 1.0;
    upper[0] = 2.0;
    std::array<int, Dim> counts;
    counts.fill(3);
    counts[0] = 4;
    const CellShape shape = Dim == 2 ? (simplices ? CellShape::triangle : CellShape::quadrangle)
                                     : (simplices ? CellShape::tetrahedron : CellShape::hexahedron);
    Vector<Dim> second = lower;
    second[0] = 1.0;
    return together(mesh::structured_box<Dim>(lower, middle, counts, shape, "left"),
                    mesh::structured_box<Dim>(second, upper, counts, shape, "right"));
}

constexpr double strength = 0.01;

template <int Dim>
solid::SolidOptions<Dim> options_of_bar(Kinematics kinematics) {
    solid::SolidOptions<Dim> options = bodies<Dim>(2);
    options.kinematics.assign(2, kinematics);
    options.law = solid::ContactLaw::pair_potential;
    options.bonds = {{.sides = {0, 1}, .strength = strength, .fracture_energy = 1e-4, .of_grains = true}};
    for (const auto* groups : {&wet, &crack, &ends})
        for (const std::string& group : *groups) options.boundary.traction.push_back({.group = group, .from_outside = true});
    return options;
}

/// A run, and what was given to it.
template <int Dim>
class LoadedBar {
public:
    LoadedBar(bool simplices, Kinematics kinematics)
        : scene_(bar<Dim>(simplices), options_of_bar<Dim>(kinematics), {Vector<Dim>::Zero(), Vector<Dim>::Zero()}),
          start_(scene_.memm.pseudo_energy()) {}

    /// A traction on all of a group from the next step on.
    void load(const std::string& group, const Vector<Dim>& traction) {
        scene_.solid.set_traction(group, std::vector<Vector<Dim>>(scene_.solid.outside(group).traction().size(), traction));
    }
    void step() {
        for (const auto* groups : {&wet, &crack, &ends})
            for (const std::string& group : *groups) {
                const auto faces = solid::outside_faces<Dim>(scene_.memm, scene_.solid, group);
                for (std::size_t i = 0; i < faces.area.size(); ++i) {
                    const Vector<Dim> impulse = scene_.memm.dt() * faces.area[i] * faces.traction[i];
                    given_[group.starts_with("left") ? 0 : 1] += impulse;
                }
            }
        scene_.memm.step();
        const double energy = scene_.memm.pseudo_energy() + scene_.solid.dissipated().total() -
                              scene_.solid.outside_work(scene_.memm.q()).steps;
        defect_ = std::max(defect_, std::abs(energy - start_));
        largest_ = std::max(largest_, scene_.memm.pseudo_energy());
    }
    [[nodiscard]] double bonded(const std::string& group) const {
        const auto faces = solid::outside_faces<Dim>(scene_.memm, scene_.solid, group);
        double sum = 0.0, all = 0.0;
        for (std::size_t i = 0; i < faces.area.size(); ++i) {
            sum += faces.area[i] * faces.bonded[i];
            all += faces.area[i];
        }
        return sum / all;
    }
    /// Momentum of both bodies along an axis, less what they were given.
    [[nodiscard]] double momentum_defect() const {
        Vector<Dim> defect = -given_[0] - given_[1];
        for (const auto& body : motions()) defect += body.mass * body.velocity;
        return defect.norm();
    }
    [[nodiscard]] std::vector<solid::BodyMotion<Dim>> motions() const {
        return solid::body_motions<Dim>(scene_.memm, scene_.solid);
    }
    [[nodiscard]] const Vector<Dim>& given(std::size_t body) const { return given_[body]; }
    [[nodiscard]] double relative_defect() const { return defect_ / largest_; }
    [[nodiscard]] Scene<Dim>& scene() { return scene_; }

private:
    Scene<Dim> scene_;
    double start_, defect_ = 0.0, largest_ = 0.0;
    std::array<Vector<Dim>, 2> given_{Vector<Dim>::Zero(), Vector<Dim>::Zero()};
};

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "faces are bonded as long as bonds hold them, and bear tractions from outside from their first step on",
    "[solid][outside][bonds][fracture]", ((int Dim), Dim), 2, 3) {
    const bool simplices = GENERATE(true, false);
    const Kinematics kinematics = GENERATE(Kinematics::floating, Kinematics::finite);
    CAPTURE(simplices, static_cast<int>(kinematics));
    LoadedBar<Dim> run(simplices, kinematics);
    const Vector<Dim> along = Vector<Dim>::Unit(0);
    for (const std::string& group : crack) CHECK(run.bonded(group) == Approx(1.0).epsilon(1e-12));
    for (const std::string& group : wet) CHECK(run.bonded(group) == 0.0);

    run.load("left.xmin", -1.5 * strength * along);
    run.load("right.xmax", 1.5 * strength * along);
    for (int i = 0; i < 2000 && run.bonded(crack[0]) > 0.0; ++i) {
        run.step();
        CHECK(run.bonded(crack[0]) == Approx(1.0 - run.scene().solid.bonds().broken_share()).epsilon(1e-12));
    }
    REQUIRE(run.scene().solid.bonds().broken_share() == 1.0);

    // What pulled ends, and a fluid presses the new faces apart.
    for (const std::string& group : ends) run.load(group, Vector<Dim>::Zero());
    const auto before = run.motions();
    const Vector<Dim> given = run.given(1);
    run.load("left.xmax", -0.5 * strength * along);
    run.load("right.xmin", 0.5 * strength * along);
    for (int i = 0; i < 300; ++i) run.step();
    const auto after = run.motions();
    const Vector<Dim> taken = after[1].mass * (after[1].velocity - before[1].velocity);
    CHECK((taken - (run.given(1) - given)).norm() < 1e-12 * run.given(1).norm());  // nothing touches
    CHECK(taken[0] > 0.0);
    CHECK(run.momentum_defect() < 1e-12 * run.given(1).norm());
    CHECK(run.relative_defect() < 1e-12);
    CHECK(run.scene().solid.contact().report().missed_contacts == 0);
}

/// The cells at both ends of a bond have a face that is loaded and one that is bonded.
TEMPLATE_TEST_CASE_SIG(
    "a fluid loads grains beside their bonds: they move as one, and break and go on with all that they get",
    "[solid][outside][bonds][fracture]", ((int Dim), Dim), 2, 3) {
    const bool simplices = GENERATE(true, false);
    CAPTURE(simplices);
    LoadedBar<Dim> run(simplices, Kinematics::floating);
    const Vector<Dim> up = Vector<Dim>::Unit(1);
    run.load("left.ymin", 0.2 * strength * up);
    run.load("right.ymin", 0.2 * strength * up);
    for (int i = 0; i < 300; ++i) run.step();
    CHECK(run.scene().solid.bonds().broken_share() == 0.0);
    const auto together = run.motions();
    CHECK(together[1].velocity[1] == Approx(together[0].velocity[1]).epsilon(0.02));
    run.load("left.ymin", Vector<Dim>::Zero());
    run.load("right.ymin", 2.0 * strength * up);
    for (int i = 0; i < 600; ++i) run.step();
    CHECK(run.scene().solid.bonds().broken_share() == 1.0);
    CHECK(run.momentum_defect() < 1e-12 * run.given(1).norm());
    CHECK(run.relative_defect() < 1e-12);
    CHECK(run.motions()[1].velocity[1] > 2.0 * run.motions()[0].velocity[1]);
}

TEST_CASE("small bodies refuse loads from outside on bonded faces and beside them", "[solid][outside][bonds]") {
    const mesh::Mesh<2> mesh = bar<2>(false);
    for (const auto& [group, words] : {std::pair{"left.xmax", "has a traction on it"}, {"left.ymin", "beside it"}}) {
        solid::SolidOptions<2> options = bodies<2>(2);
        options.bonds = {{.sides = {0, 1}, .strength = strength}};
        options.boundary.traction = {{.group = group, .from_outside = true}};
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains(words) && Contains(group));
    }
}
