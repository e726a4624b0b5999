// The tables of what bodies of each kinematics are, and of features that do not go together, and what solids do.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <functional>
#include <string>

#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/part/share_out.hpp"
#include "abut/solid/statics.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Feature;
using solid::Kinematics;

namespace {

using Options = solid::SolidOptions<2>;

constexpr std::array all_kinematics{Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid};

/// A solid of two boxes side by side that asks for a feature of the table.
struct Asked {
    Feature feature;
    std::function<void(Options&)> change;
    std::function<void(solid::Solid<2>&)> use = [](solid::Solid<2>&) {};
};

solid::DirichletCondition<2> held(solid::Constraint constraint) {
    return {.group = "left.xmin", .constraint = constraint, .value = Vector<2>::Zero(), .history = {}};
}

void seek_rest(solid::Solid<2>& solid) {
    static_cast<void>(solid::solve_statics<2>(solid, std::vector<double>(solid.size(), 0.0)));
}

void yield_at(double stress, solid::Material& material) {
    material.law = solid::MaterialLaw::j2;
    material.flow.yield_stress = stress;
}

std::vector<Asked> all_asked() {
    return {
        {Feature::clamp, [](Options& o) { o.boundary.dirichlet = {held(solid::Constraint::full)}; }},
        {Feature::guide, [](Options& o) { o.boundary.dirichlet = {held(solid::Constraint::normal)}; }},
        {Feature::following_from_outside,
         [](Options& o) {
             o.boundary.traction = {{.group = "left.xmin", .history = {}, .follows = true, .from_outside = true}};
         }},
        {Feature::bond,
         [](Options& o) {
             o.bonds = {{.sides = {0, 1}}};
         }},
        {Feature::large_strains, [](Options& o) { o.materials[0].law = solid::MaterialLaw::neo_hookean; }},
        {Feature::flow, [](Options& o) { yield_at(1e-3, o.materials[0]); }},
        {Feature::temperature,
         [](Options& o) {
             for (solid::Material& material : o.materials) material.expansion.along_1 = 0.01;
             o.temperature_rise.assign(2, {.value = [](double, const Vector<2>&) { return 1.0; }});
         }},
        {Feature::damping, [](Options& o) { o.materials[0].damping.stiffness = 1e-3; }},
        {Feature::single_precision, [](Options& o) { o.precision = solid::Precision::single_precision; }},
        {Feature::rest, [](Options&) {}, seek_rest},
        {Feature::loaded_rest,
         [](Options& o) {
             o.boundary.traction = {{.group = "left.xmin", .value = {1e-6, 0.0}, .history = {}}};
         },
         seek_rest},
        {Feature::local_steps, [](Options&) {},
         [](solid::Solid<2>& solid) { solid::require_together<2>(solid.mesh(), solid.options(), {Feature::local_steps}); }},
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
    for (const Kinematics kinematics : all_kinematics) {
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

TEST_CASE("each feature has its words, in the order of their numbers, and each row a reason and a remedy",
          "[solid][combinations]") {
    for (std::size_t i = 0; i < solid::n_features; ++i) {
        CAPTURE(solid::feature_words[i].name);
        CHECK(solid::feature_words[i].feature == static_cast<Feature>(i));
        CHECK_FALSE(solid::feature_words[i].clause.empty());
    }
    for (const solid::Combination& row : solid::combinations) {
        CAPTURE(solid::words_of(row.feature).name);
        CHECK_FALSE(row.without.is_empty());
        CHECK_FALSE(row.without.has(row.feature));
        CHECK_FALSE(row.reason.ends_with('.'));
        CHECK(row.remedy.ends_with('.'));
    }
    for (const Kinematics kinematics : all_kinematics)
        CHECK(solid::words_of(solid::feature_of(kinematics)).name ==
              "kinematics \"" + std::string(solid::properties_of(kinematics).name) + "\"");
}

TEST_CASE("no two features stand in two rows of the table", "[solid][combinations]") {
    for (std::size_t i = 0; i < solid::combinations.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const solid::Combination &one = solid::combinations[i], &other = solid::combinations[j];
            CAPTURE(solid::words_of(one.feature).name, solid::words_of(other.feature).name);
            if (one.feature == other.feature) CHECK((one.without & other.without).is_empty());
            if (one.without.has(other.feature)) CHECK_FALSE(other.without.has(one.feature));
        }
}

TEST_CASE("a conflict is found from either side, and not where neither feature is asked for", "[solid][combinations]") {
    CHECK_FALSE(solid::go_together(Feature::flow, Feature::rigid));
    CHECK_FALSE(solid::go_together(Feature::rigid, Feature::flow));
    CHECK(solid::go_together(Feature::flow, Feature::floating));
    CHECK_FALSE(solid::first_conflict({Feature::flow, Feature::rigid, Feature::bond}, {Feature::clamp}));
    const auto found = solid::first_conflict({Feature::flow, Feature::rigid}, {Feature::rigid});
    REQUIRE(found);
    CHECK(solid::text_of(*found, "body 'ring'") ==
          "body 'ring' is rigid and yields (law = \"j2\"): nothing deforms. Take other kinematics, or another law.");
}

TEST_CASE("frames at given times go with all that steps as a whole and is written as one", "[solid][combinations]") {
    for (const solid::FeatureWords& words : solid::feature_words) {
        CAPTURE(words.name);
        const bool is_refused = words.feature == Feature::local_steps || words.feature == Feature::pieces;
        CHECK(solid::go_together(Feature::output_times, words.feature) != is_refused);
    }
    const auto found = solid::first_conflict({Feature::output_times, Feature::pieces}, {Feature::pieces});
    REQUIRE(found);
    CHECK(
        solid::text_of(*found).starts_with("ranks write pieces of frames (--pieces), and frames are at given times "
                                           "(output.times): pieces are those of nodes. Leave --pieces out"));
}

TEST_CASE("a solid refuses by its kinematics what the table says, with its reason and remedy, and nothing else",
          "[solid][combinations]") {
    const auto mesh = together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {3, 3}, CellShape::quadrangle, "left"),
                               mesh::structured_box<2>({1.0, 0.0}, {2.0, 0.5}, {3, 3}, CellShape::quadrangle, "right"));
    for (const Asked& asked : all_asked())
        for (const Kinematics kinematics : all_kinematics) {
            CAPTURE(solid::words_of(asked.feature).name, static_cast<int>(kinematics));
            Options options = bodies<2>(2);
            options.contact.reset();
            options.kinematics.assign(2, kinematics);
            asked.change(options);
            const std::string message = said(mesh, options, asked);
            CAPTURE(message);
            const bool has_reason = std::ranges::any_of(solid::combinations, [&](const solid::Combination& row) {
                return message.ends_with(std::string(row.reason) + ". " + std::string(row.remedy));
            });
            CHECK(has_reason != solid::go_together(asked.feature, solid::feature_of(kinematics)));
        }
}

TEST_CASE("a solid refuses by its law of contact and its precision what the table says", "[solid][combinations]") {
    const auto mesh = together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {3, 3}, CellShape::quadrangle, "left"),
                               mesh::structured_box<2>({1.0, 0.0}, {2.0, 0.5}, {3, 3}, CellShape::quadrangle, "right"));
    const auto refusal = [&](const std::function<void(Options&)>& change) {
        Options options = bodies<2>(2);
        options.contact = contact::ContactOptions{};
        options.law = solid::ContactLaw::reconstruction;
        change(options);
        return said(mesh, options, {Feature::reconstruction, change});
    };
    using Catch::Contains;
    CHECK(refusal([](Options&) {}).empty());
    CHECK_THAT(refusal([](Options& o) { o.kinematics.assign(2, Kinematics::floating); }),
               Contains("body 'left' may turn, and contact is by ContactLaw::reconstruction"));
    CHECK_THAT(refusal([](Options& o) { yield_at(1e-3, o.materials[1]); }), Contains("body 'right' yields"));
    CHECK_THAT(refusal([](Options& o) {
                   o.bonds = {{.sides = {0, 1}, .strength = 1.0}};
               }),
               Contains("a bond has a strength"));
    CHECK_THAT(refusal([](Options& o) { o.interference = {{{0, 1}, 1.0}}; }), Contains("overlap at the start on purpose"));
    CHECK_THAT(refusal([](Options& o) {
                   o.precision = solid::Precision::single_precision;
                   o.device = solid::StepDevice::kokkos;
               }),
               Contains("single precision, and steps of the bulk are made on a device"));
}
