// Features of a scene that do not go with its scheme, and what runs do.
#include <catch2/catch.hpp>
#include <functional>
#include <string>

#include "abut/base/error.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using solid::Feature;

/// A block that falls on a plane and asks for a feature.
struct Asked {
    Feature feature;
    std::function<void(run::Scene<2>&)> change;
};

std::vector<Asked> all_asked() {
    return {
        {Feature::erosion, [](run::Scene<2>& scene) { scene.solid.erosion = {{.strain = 0.5}}; }},
        {Feature::damping, [](run::Scene<2>& scene) { scene.solid.materials[0].damping.mass = 0.1; }},
        {Feature::friction,
         [](run::Scene<2>& scene) {
             scene.solid.body_friction = {{{0, 1}, {.coefficient = 0.3}}};
         }},
        {Feature::rigid, [](run::Scene<2>& scene) { scene.solid.kinematics = {solid::Kinematics::rigid}; }},
        {Feature::interference,
         [](run::Scene<2>& scene) {
             scene.solid.interference = {{.bodies = {0, 1}, .time = 0.1}};
         }},
        {Feature::varying_load,
         [](run::Scene<2>& scene) {
             scene.solid.boundary.traction = {
                 {.group = "xmin", .history = [](double t, const Vector<2>&) { return Vector<2>(1e-3 * t, 0.0); }}};
         }},
        {Feature::outside_work,
         [](run::Scene<2>& scene) { scene.solid.obstacles[0].path = [](double t) { return Vector<2>(0.0, -1e-3 * t); }; }},
        {Feature::outside_work, [](run::Scene<2>& scene) {
             scene.solid.springs = {{.first = {.body = 0, .position = {0.5, 0.5}, .radius = 1.0},
                                     .second = {.position = {0.5, 2.0}},
                                     .damping = 1e-3}};
         }}};
}

/// "": the run went well.
std::string said(const run::Scene<2>& scene, const run::RunOptions& options) {
    try {
        static_cast<void>(run::simulate<2>(scene, options));
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("runs refuse by their schemes what the table says, and make what it does not say", "[run][combinations]") {
    for (const auto& [word, scheme] : run::integrator_words)
        for (const Asked& asked : all_asked()) {
            CAPTURE(word, solid::words_of(asked.feature).name);
            run::RunOptions options{.steps = 1, .integrator = scheme};
            if (scheme == run::SolidIntegrator::memm_async) options.law = solid::ContactLaw::reconstruction;
            run::Scene<2> scene = test::block_on_plane(1e-3);
            asked.change(scene);
            solid::FeatureSet features = run::features_of(options);
            features.add(asked.feature);
            features.add(Feature::reconstruction, options.law == solid::ContactLaw::reconstruction);
            features.add(Feature::turn, asked.feature == Feature::rigid);
            const std::string message = said(scene, options);
            CAPTURE(message);
            CHECK(message.empty() == !solid::first_conflict(features, features));
        }
}

TEST_CASE("a run says which features do not go together, in the words of its options", "[run][combinations]") {
    CHECK_THROWS_WITH(run::check(run::RunOptions{.format = run::FrameFormat::xdmf, .pieces = true}),
                      Catch::Contains("--pieces") && Catch::Contains("--format xdmf"));
    run::Scene<2> scene = test::block_on_plane(1e-3);
    scene.solid.materials[0].damping.mass = 0.1;
    CHECK_THAT(said(scene, {.steps = 1, .integrator = run::SolidIntegrator::leapfrog}),
               Catch::Contains("body '" + scene.mesh.body_names[0] + "' has a damped or viscous material") &&
                   Catch::Contains("leapfrog") && Catch::Contains("Take the scheme memm"));
}

TEST_CASE("a rigid body that spins neither begins displaced nor comes to rest first", "[run][combinations]") {
    run::Scene<2> scene = test::block_on_plane(1e-3);
    scene.solid.kinematics = {solid::Kinematics::rigid};
    scene.spin = {AxialVector<2>(0.1)};
    CHECK(said(scene, {.steps = 1}).empty());
    CHECK_THAT(said(scene, {.steps = 1, .settle = true}), Catch::Contains("spins") && Catch::Contains("settle"));
    scene.displacement = [](const Vector<2>&) -> Vector<2> { return {0.0, 1e-3}; };
    CHECK_THAT(said(scene, {.steps = 1}), Catch::Contains("Turn its mesh instead"));
    scene.solid.kinematics = {solid::Kinematics::small};
    CHECK(said(scene, {.steps = 1}).empty());
}
