#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/warnings.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/run/steps/simulation.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using run::WarningKind;

std::vector<WarningKind> kinds(const std::vector<run::Warning>& warnings) {
    std::vector<WarningKind> result;
    for (const run::Warning& warning : warnings) result.push_back(warning.kind);
    return result;
}

}  // namespace

TEST_CASE("a run in which nothing went wrong has no warning", "[run][warnings]") {
    const run::Scene<2> scene = test::block_on_plane(1e-3);
    // Of two cells across, H - H~ is 0.2 K0 at a CFL number of 0.9: it goes with the square of the step.
    const run::RunResult<2> result = run::simulate<2>(scene, {.cfl = 0.2});
    REQUIRE(result.contact.report.active_pairs_max > 0);
    CHECK(run::warnings_before(scene, result).empty());
    CHECK(run::warnings_during(result.run.steps, result).empty());
    CHECK(run::without_notes(run::warnings_after(result)).empty());
}

TEST_CASE("each figure above its threshold is a warning of its kind with value and threshold, and none at it",
          "[run][warnings]") {
    run::RunResult<2> result;
    result.run.dt = result.run.finest_dt = 1.0;
    result.run.steps = 10;
    result.contact.report.sliding_ratio_max = run::stiff_sliding_ratio;
    result.contact.report.slipped_compression_max = run::deep_slip_compression;
    CHECK(run::warnings_after(result).empty());
    result.contact.report.sliding_ratio_max *= 2.0;
    result.contact.report.slipped_compression_max *= 2.0;
    result.contact.report.missed_contacts = 3;
    result.watch.compressed = {"'a'", "obstacle 'floor'", 0.5, 4};
    result.contact.inadmissible_overlaps_max = 7;
    const auto warnings = run::warnings_after(result);
    CHECK(kinds(warnings) == std::vector{WarningKind::compression, WarningKind::stiff_sliding, WarningKind::deep_slip,
                                         WarningKind::missed_contacts, WarningKind::inadmissible_overlaps});
    const std::vector<double> values{0.5, 2.0, 0.6, 3.0, 7.0}, thresholds{0.3, 1.0, 0.3, 0.0, 0.0};
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        CHECK(warnings[i].value == values[i]);
        CHECK(warnings[i].threshold == thresholds[i]);
        CHECK_FALSE(warnings[i].text.empty());
    }
    CHECK(run::without_notes(warnings).size() == 4);
    CHECK(kinds(run::warnings_during(3, result)) == std::vector{WarningKind::compression});
}

TEST_CASE("a run does not begin with a cell a hundred times as fast as most of its body, unless its step is given",
          "[run][warnings]") {
    // Two rows of squares of 1, and last cells of width w: 2 d area/outline is 2 w/(1 + w), and 1 for a square.
    const auto rows = [](double width) {
        mesh::CellSoup<2> soup{.name = "rows"};
        for (int i = 0; i <= 6; ++i)
            for (int k = 0; k <= 2; ++k) soup.vertices.push_back({std::min<double>(i, 5.0 + width), static_cast<double>(k)});
        for (int i = 0; i < 12; ++i) {
            const int corner = 3 * (i / 2) + i % 2;
            soup.cell_shape.push_back(mesh::CellShape::quadrangle);
            soup.cell_vertices.append(std::array{corner, corner + 3, corner + 4, corner + 1});
            soup.cell_body.push_back(0);
        }
        soup.body_names = {"rows"};
        return mesh::build_mesh<2>(std::move(soup));
    };
    const auto scene_of = [](mesh::Mesh<2> bodies) {
        run::Scene<2> scene;
        scene.solid.materials.resize(static_cast<std::size_t>(bodies.n_bodies()), {.young = 1.0, .density = 1.0});
        scene.velocity.resize(static_cast<std::size_t>(bodies.n_bodies()), Vector<2>(0.1, 0.0));
        scene.mesh = std::move(bodies);
        return scene;
    };
    const run::RunOptions options{.steps = 1};
    CHECK_NOTHROW(run::simulate<2>(scene_of(rows(0.0051)), options));  // 0.0101 of the median
    const run::Scene<2> uneven = scene_of(rows(0.0049));               // 0.0098
    try {
        static_cast<void>(run::simulate<2>(uneven, options));
        FAIL("one cell takes 0.0098 of the median");
    } catch (const BadInput& error) {
        CHECK(error.facts().cell >= 10);
        CHECK(error.facts().value == Approx(2.0 * 0.0049 / 1.0049));
        CHECK(error.facts().allowed == run::least_cell_share);
    }
    CHECK_NOTHROW(run::simulate<2>(uneven, {.steps = 1, .dt = 1e-5}));
    // A body of small cells is as even as one of large ones.
    mesh::Mesh<2> small =
        mesh::structured_box<2>({10.0, 0.0}, {10.004, 0.002}, {4, 2}, mesh::CellShape::quadrangle, "small");
    CHECK_NOTHROW(run::simulate<2>(scene_of(mesh::combine<2>(std::vector{rows(1.0), std::move(small)})), options));
}

TEST_CASE("a finite body that is strained too far is told of, with how near a cell came to a collapse", "[run][warnings]") {
    run::RunResult<2> result;
    result.run.dt = result.run.finest_dt = 1.0;
    result.bodies.finite = {.determinant = 0.43, .strain = run::large_strain, .cell = 3};
    CHECK(run::warnings_after(result).empty());
    result.bodies.finite.strain = 0.31;
    const auto warnings = run::warnings_after(result);
    CHECK(kinds(warnings) == std::vector{WarningKind::finite_strain});
    CHECK(warnings.front().value == 0.31);
    CHECK(warnings.front().threshold == run::large_strain);
    CHECK(warnings.front().text.find("0.43") != std::string::npos);
    CHECK(warnings.front().text.find("quadratic_viscosity") != std::string::npos);  // what a shock needs
}

TEST_CASE("finite metal with kinematic hardening that flows far is told of, and no other", "[run][warnings]") {
    run::RunResult<2> result;
    result.run.dt = result.run.finest_dt = 1.0;
    result.bodies.finite.plastic_strain = 0.7;
    CHECK(run::warnings_after(result).empty());
    result.bodies.finite_kinematic_hardening = true;
    const auto warnings = run::warnings_after(result);
    REQUIRE(kinds(warnings) == std::vector{WarningKind::kinematic_flow});
    CHECK(warnings.front().value == 0.7);
    CHECK(warnings.front().threshold == run::large_kinematic_flow);
    result.bodies.finite.plastic_strain = run::large_kinematic_flow;
    CHECK(run::warnings_after(result).empty());

    for (const auto kinematics : {abut::solid::Kinematics::small, abut::solid::Kinematics::finite}) {
        run::Scene<2> scene = test::block_on_plane(1e-3);
        scene.mesh =
            abut::mesh::structured_box<2>({0.0, 1e-3}, {1.0, 1.0}, {3, 3}, abut::mesh::CellShape::quadrangle, "block");
        scene.solid.materials[0].law = abut::solid::MaterialLaw::j2;
        scene.solid.materials[0].flow.yield_stress = 1.0;
        scene.solid.materials[0].flow.kinematic_hardening = 0.1;
        scene.solid.kinematics = {kinematics};
        CHECK(run::simulate<2>(scene, {.steps = 1}).bodies.finite_kinematic_hardening ==
              (kinematics == abut::solid::Kinematics::finite));
    }
}

TEST_CASE("free faces that take much of what plastic flow dissipates are told of, whatever the sign", "[run][warnings]") {
    const auto result_with = [](double share) {
        run::RunResult<2> result;
        result.run.dt = result.run.finest_dt = 1.0;
        result.energy.dissipated = {.in_cells = 2.0, .on_faces = 2.0 * share};
        return run::warnings_after(result);
    };
    CHECK(result_with(run::large_face_loss).empty());
    for (const double share : {0.16, -0.16}) {
        const auto warnings = result_with(share);
        REQUIRE(kinds(warnings) == std::vector{WarningKind::face_loss});
        CHECK(warnings.front().value == Approx(0.16));
        CHECK_THAT(warnings.front().text, Catch::Contains("0.16") && Catch::Contains("smaller cells"));
    }
}

TEST_CASE("plastic flow that gives energy back from record to record is told of, with faces and jumps as a whole",
          "[run][warnings]") {
    using dynamics::Losses;
    const auto warnings_of = [](const std::vector<Losses>& records) {
        run::RunResult<2> result;
        for (const Losses& losses : records) {
            dynamics::LedgerEntry<2> entry{};
            entry.losses = losses;
            result.ledger.record(entry);
        }
        return run::warnings_after(result);
    };
    // Faces may give back what cells take, and damping what it has held.
    CHECK(warnings_of({{}, {.in_cells = 1.0}, {.in_cells = 1.5, .on_faces = -0.5}}).empty());
    CHECK(warnings_of({{}, {.in_cells = 1.0, .lagged = 0.5}, {.in_cells = 1.0}}).empty());
    // Twice 0.02 of 2 J, of which 0.01 are safe.
    const auto warnings = warnings_of({{},
                                       {.in_cells = 1.0},
                                       {.in_cells = 1.0, .on_faces = -0.04},
                                       {.in_cells = 1.5, .in_jumps = 0.54, .on_faces = -0.04},
                                       {.in_cells = 1.5, .in_jumps = 0.54, .on_faces = -0.08}});
    REQUIRE(kinds(warnings) == std::vector{WarningKind::returned_flow});
    CHECK(warnings.front().value == Approx(0.04));
    CHECK_THAT(warnings.front().text, Catch::Contains("2 records") && Catch::Contains("smaller cells"));
}

TEST_CASE("jumps that yield where cells hardly flow are told of, and stand in the summary where no cell does",
          "[run][warnings]") {
    run::RunResult<2> result;
    result.run.dt = result.run.finest_dt = 1.0;
    result.energy.dissipated = {.in_cells = 0.9, .in_jumps = 0.1};
    CHECK(run::warnings_after(result).empty());
    result.energy.dissipated = {.in_jumps = 0.5};
    const auto warnings = run::warnings_after(result);
    REQUIRE(kinds(warnings) == std::vector{WarningKind::jump_loss});
    CHECK(warnings.front().value == 1.0);
    CHECK_THAT(warnings.front().text, Catch::Contains("jump_cap"));
    result.ledger.record({});
    CHECK_THAT(run::summary_json("mine", test::block_on_plane(1e-3), result),
               Catch::Contains("\"dissipated_in_jumps\": 0.5"));
}

TEST_CASE("a slip that alternates in a fortieth of the records is told of wherever it is, though the whole run slides well",
          "[run][warnings]") {
    const auto result_with = [](std::int64_t begin, std::int64_t end) {
        run::RunResult<2> result;
        for (std::int64_t i = 0; i < 2000; ++i) {
            const double limit = i < 900 ? 1.0 : i < 950 ? 0.0 : 1e-3;  // it slides, sticks, and slips a little now and then
            result.contact.report.sliding_limit += limit;
            result.contact.report.sliding_force += limit * (begin <= i && i < end ? 0.05 : 0.95);
            result.contact.sliding.record(result.contact.report);
        }
        return result;
    };
    CHECK(run::warnings_after(result_with(0, 0)).empty());
    CHECK(run::warnings_after(result_with(1000, 1050)).empty());  // hardly anything slides
    for (const std::int64_t begin : {0, 13, 25, 387, 840}) {
        const run::RunResult<2> result = result_with(begin, begin + 50);
        CHECK(result.contact.report.sliding_force > 0.85 * result.contact.report.sliding_limit);
        const auto warnings = run::warnings_after(result);
        REQUIRE(kinds(warnings) == std::vector{WarningKind::alternating_slip});
        CHECK(warnings.front().value < 0.06);
        CHECK(warnings.front().threshold == run::least_sliding_share);
    }
}

TEST_CASE("a body that turns and should not is told of from 0.1 rad on by name, with what it has grown by",
          "[run][warnings]") {
    for (const double angle : {0.09, 0.2}) {
        run::RunResult<2> result;
        dynamics::LedgerEntry<2> entry{};
        entry.rotation = 3.0;  // of another body, which may
        result.ledger.record(entry);
        result.watch.turned = {"'block'", angle};
        const auto warnings = run::warnings_after(result);
        REQUIRE(warnings.size() == (angle > 0.1 ? 1 : 0));
        if (warnings.empty()) continue;
        CHECK(warnings[0].kind == WarningKind::rotation);
        CHECK(warnings[0].value == angle);
        CHECK_THAT(warnings[0].text, Catch::Contains("'block' has turned") && Catch::Contains("2 % at this angle"));
    }
}

TEST_CASE("a cell that turns within its body is told of where that body may turn, beside others that may not",
          "[run][warnings]") {
    run::RunResult<2> result;
    result.bodies.local_rotations = {0.5, 0.2};
    result.bodies.may_turn = {false, true};
    const auto warnings = run::warnings_after(result);
    REQUIRE(kinds(warnings) == std::vector{WarningKind::local_rotation});
    CHECK(warnings[0].value == 0.2);
    result.bodies.may_turn = {false, false};
    CHECK(run::warnings_after(result).empty());
}

TEST_CASE("H - H~ is measured by the energy in play, whatever scale figures are quoted on", "[run][warnings]") {
    run::RunResult<2> result;
    result.energy.scale = {"H0", 1.0};
    for (const double excess : {0.0, 0.0019, 0.0021}) {  // of 0.1 J, of which 2 % are safe
        dynamics::LedgerEntry<2> entry{};
        entry.energy = 0.1 + excess;
        entry.pseudo_energy = 0.1;
        entry.kinetic = 0.1;
        result.ledger.record(entry);
        result.energy.accounts.record(entry, 1.0, Vector<2>::Zero());
        const auto warnings = run::warnings_after(result);
        CHECK(kinds(warnings) == (excess > 0.002 ? std::vector{WarningKind::energy_excess} : std::vector<WarningKind>{}));
    }
}

TEST_CASE("edges that would cross unseen are told of, with their angles and the limit", "[run][warnings]") {
    run::Scene<3> scene;
    run::RunResult<3> result;
    CHECK(run::warnings_before(scene, result).empty());
    result.contact.unseen_edges = contact::EdgePair<3>{{0, 0.3, Vector<3>(1.0, 2.0, 3.0)}, {1, 0.5, Vector<3>::Zero()}};
    const auto warnings = run::warnings_before(scene, result);
    REQUIRE(kinds(warnings) == std::vector{WarningKind::unseen_edges});
    CHECK(warnings[0].value == 0.15);
    CHECK(warnings[0].threshold == 0.2);
    for (const char* part : {"34.9 and 60 degrees", "(1, 2, 3)", "--lab facing_cosine"})
        CHECK(warnings[0].text.find(part) != std::string::npos);
    // y^2 (3 - 2 y) = 1/4 of the fade from -0.6 to -0.2
    result.options.law = solid::ContactLaw::pair_potential;
    CHECK(run::warnings_before(scene, result)[0].threshold == Approx(0.2 + 0.4 * (0.5 - std::sin(std::numbers::pi / 18.0))));
}

TEST_CASE("what a mesh left out and corners that contact cannot see are known before the first step", "[run][warnings]") {
    run::Scene<2> scene = test::block_on_plane(1e-3);
    run::RunResult<2> result;
    auto& report = scene.mesh.report;
    report.warnings = {"node 3 is lonely"};
    report.n_unused_vertices = 1;
    report.n_ignored_elements = 2;
    report.n_turned_cells = 3;
    report.n_cut_cells = 4;
    report.n_coincident_vertices = 5;
    result.bodies.unjoined.n_faces = 6;
    result.bodies.unjoined.body = "block";
    result.bodies.stencils.extrapolated = 7;
    result.contact.blind_corners.assign(8, {.body = 0, .position = {0.5, 0.25}});
    const auto warnings = run::warnings_before(scene, result);
    CHECK(kinds(warnings) == std::vector{WarningKind::mesh_file, WarningKind::unused_vertices, WarningKind::ignored_elements,
                                         WarningKind::turned_cells, WarningKind::cut_cells, WarningKind::coincident_vertices,
                                         WarningKind::unjoined_faces, WarningKind::extrapolated_faces,
                                         WarningKind::blind_corners});
    CHECK(warnings.front().text == "mesh file: node 3 is lonely");
    for (std::size_t i = 1; i < warnings.size(); ++i) CHECK(warnings[i].value == static_cast<double>(i));
    for (const std::string& part :
         {"body '" + scene.mesh.body_names[0] + "'", std::string("0.5, 0.25"), std::string("--lab facing_cosine")})
        CHECK(warnings.back().text.find(part) != std::string::npos);
    result.options.law = solid::ContactLaw::pair_potential;  // which has a fade of its own
    const std::string text = run::warnings_before(scene, result).back().text;
    CHECK(text.find("--facing-none") != std::string::npos);
    CHECK(text.find("--lab facing_cosine") == std::string::npos);
    // What nobody can act on, or is meant most often, is a note.
    CHECK(kinds(run::without_notes(warnings)) ==
          std::vector{WarningKind::mesh_file, WarningKind::unjoined_faces, WarningKind::blind_corners});
}

TEST_CASE("records that all come right after a restart are told of", "[run][warnings]") {
    run::Scene<2> scene;
    run::RunResult<2> result;
    for (const auto& [interval, restart, hidden] :
         {std::tuple{100, 50, true}, {50, 50, true}, {101, 50, false}, {10, 50, false}, {50, 0, false}}) {
        result.options.interval = interval;
        result.options.restart = restart;
        const auto warnings = run::warnings_before(scene, result);
        REQUIRE(warnings.size() == (hidden ? 1 : 0));
        if (!hidden) continue;
        CHECK(warnings[0].kind == WarningKind::hidden_mode);
        CHECK(warnings[0].value == interval);
        CHECK(warnings[0].threshold == restart);
    }
}
