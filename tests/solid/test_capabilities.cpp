// The tables of what bodies of each kinematics are and have, and what solids do.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <regex>
#include <string>

#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/kinematics/capabilities.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/local_step_checks.hpp"
#include "abut/solid/part/share_out.hpp"
#include "abut/solid/statics.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Capability;
using solid::Kinematics;

namespace {

using Options = solid::SolidOptions<2>;

/// What a solid says to a scene that asks for one of them, of two boxes side by side.
struct Asked {
    Capability capability;
    std::string refusal;  ///< in the message where it is refused: a regular expression
    std::function<void(Options&)> change;
    std::function<void(solid::Solid<2>&)> use = [](solid::Solid<2>&) {};
};

solid::DirichletCondition<2> held(solid::Constraint constraint) {
    return {.group = "left.xmin", .constraint = constraint, .value = Vector<2>::Zero(), .history = {}};
}

void seek_rest(solid::Solid<2>& solid) {
    static_cast<void>(solid::solve_statics<2>(solid, std::vector<double>(solid.size(), 0.0)));
}

std::vector<Asked> all_asked() {
    return {
        {Capability::clamp, "which only bodies of",
         [](Options& o) { o.boundary.dirichlet = {held(solid::Constraint::full)}; }},
        {Capability::guide, "prescribed", [](Options& o) { o.boundary.dirichlet = {held(solid::Constraint::normal)}; }},
        {Capability::following_from_outside, "and the traction from outside on",
         [](Options& o) {
             o.boundary.traction = {{.group = "left.xmin", .history = {}, .follows = true, .from_outside = true}};
         }},
        {Capability::bond, "cannot be bonded",
         [](Options& o) {
             o.bonds = {{.sides = {0, 1}}};
         }},
        {Capability::large_strains, "law of large strains",
         [](Options& o) { o.materials[0].law = solid::MaterialLaw::neo_hookean; }},
        {Capability::flow, "yields",
         [](Options& o) {
             o.materials[0].law = solid::MaterialLaw::j2;
             o.materials[0].yield_stress = 1e-3;
         }},
        {Capability::temperature, "is given a temperature",
         [](Options& o) {
             for (solid::Material& material : o.materials) material.thermal_expansion = 0.01;
             o.temperature_rise.assign(2, {.value = [](double, const Vector<2>&) { return 1.0; }});
         }},
        {Capability::damping, "damped or viscous", [](Options& o) { o.materials[0].stiffness_damping = 1e-3; }},
        {Capability::rest, "bodies at rest are sought for", [](Options&) {}, seek_rest},
        {Capability::loaded_rest, "statics: tractions and moments|bodies at rest are sought for",
         [](Options& o) {
             o.boundary.traction = {{.group = "left.xmin", .value = {1e-6, 0.0}, .history = {}}};
         },
         seek_rest},
        {Capability::local_steps, "local steps are for", [](Options&) {},
         [](solid::Solid<2>& solid) { solid::require_local_steps<2>("mesh", solid.options(), true); }},
    };
}

/// "": nothing was thrown.
std::string said(const mesh::Mesh<2>& mesh, const Options& options, const Asked& asked) {
    try {
        solid::Solid<2> solid(mesh, options);
        asked.use(solid);
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a solid is what the table of its kinematics says", "[solid][kinematics]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {4, 3}, CellShape::quadrangle, "box");
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid}) {
        const solid::KinematicsProperties& is = solid::properties_of(kinematics);
        CAPTURE(is.name);
        Options options = bodies<2>(1);
        options.contact.reset();
        options.kinematics = {kinematics};
        solid::Solid<2> solid(mesh, options);
        CHECK(solid.rest_positions().size() == (is.deforms ? 12 : 3));
        CHECK((solid.moment_arms() != dynamics::MomentArms::rest) == is.turns);
        CHECK(solid.step_margin() == is.step_margin);
        CHECK(solid::copy_layers(options.kinematics) == solid::copy_layers({}) + is.more_layers);

        // Of a bend by u_y = a x^2 a linear body has twice the force where a is doubled; a frame takes out its mean turn alone.
        const auto forces_of_bend = [&](double a) {
            std::vector<Vector<2>> bend;
            for (const Vector<2>& x : mesh.cell_centroid) bend.push_back({0.0, a * (x[0] - 0.5) * (x[0] - 0.5)});
            std::vector<double> force(solid.size());
            solid.force(solid.cells().to_q(bend), force);
            return force;
        };
        const std::vector<double> once = forces_of_bend(0.05), twice = forces_of_bend(0.1);
        double largest = 0.0, off = 0.0;
        for (std::size_t i = 0; i < once.size(); ++i) {
            largest = std::max(largest, std::abs(twice[i]));
            off = std::max(off, std::abs(twice[i] - 2.0 * once[i]));
        }
        if (is.deforms) CHECK((off > 1e-6 * largest) == is.finite_strains);
    }
}

TEST_CASE("each capability has its line in the table, in the order of their numbers", "[solid][kinematics]") {
    for (std::size_t i = 0; i < solid::capabilities.size(); ++i) {
        const solid::CapabilityRow& row = solid::capabilities[i];
        CAPTURE(row.name);
        CHECK(row.capability == static_cast<Capability>(i));
        CHECK_FALSE(row.reason.empty());
        CHECK(std::ranges::count(row.of, false) > 0);
    }
}

TEST_CASE("a solid refuses by its kinematics what the table says, and nothing else", "[solid][kinematics]") {
    const auto mesh = together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {3, 3}, CellShape::quadrangle, "left"),
                               mesh::structured_box<2>({1.0, 0.0}, {2.0, 0.5}, {3, 3}, CellShape::quadrangle, "right"));
    for (const Asked& asked : all_asked())
        for (const Kinematics kinematics :
             {Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid}) {
            CAPTURE(solid::capabilities[static_cast<std::size_t>(asked.capability)].name, static_cast<int>(kinematics));
            Options options = bodies<2>(2);
            options.contact.reset();
            options.kinematics.assign(2, kinematics);
            asked.change(options);
            const std::string message = said(mesh, options, asked);
            CAPTURE(message);
            const bool refused = std::regex_search(message, std::regex(asked.refusal));
            CHECK(refused != solid::has(kinematics, asked.capability));
        }
}
