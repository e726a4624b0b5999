#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/io/read_vtu.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/values/sight.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

namespace fs = std::filesystem;
namespace run = abut::run;
namespace test = abut::test;
using abut::Vector;
using test::Folder;
using test::read_text;

/// Copies of what observers are told of a failure.
struct Witness : run::Observer<2> {
    void fail(const run::Failure& failure, const run::Sight<2>& shown) override {
        ++failures;
        not_evaluated = failure.not_evaluated;
        displacement = shown.displacement;
        velocity = shown.velocity;
        stress = shown.stress;
        sound = failure.sound;
        if (failure.lost) lost = *failure.lost;
        cells = failure.cells;
    }
    int failures = 0;
    abut::dynamics::IntegratorState sound, lost;
    std::vector<std::int32_t> cells;
    std::string not_evaluated;
    std::vector<Vector<2>> displacement, velocity;
    std::vector<abut::Matrix<2>> stress;
};

/// Two blocks far from each other, of which the finer one is unstable with a step that the other one bears.
run::Scene<2> coarse_and_fine() {
    run::Scene<2> scene;
    const std::array parts{
        abut::mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {2, 2}, abut::mesh::CellShape::quadrangle, "coarse"),
        abut::mesh::structured_box<2>({9.0, 0.0}, {10.0, 1.0}, {8, 8}, abut::mesh::CellShape::quadrangle, "fine")};
    scene.mesh = abut::mesh::combine<2>(parts);
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    scene.velocity.assign(2, Vector<2>::Zero());
    scene.displacement = [](const Vector<2>& x) { return Vector<2>(1e-3 * x.x() * x.x(), 0.0); };
    scene.contact = false;
    scene.energy_scale = {"E0", 1e-6};
    return scene;
}

run::RunOptions unstable_options(const run::Scene<2>& scene) {
    run::RunOptions options{.steps = 10'000, .allow_unstable = true, .interval = 1};
    options.dt = 2.0 * run::simulate<2>(scene, {.steps = 1}).run.stable.dt;
    return options;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

double fastest(const abut::dynamics::IntegratorState& state) {
    double most = 0.0;
    for (const double p : state.p_after) most = std::max(most, std::abs(p));
    return most;
}

}  // namespace

TEST_CASE("a run that diverges names a cell of the body that is unstable, and shows its last sound state",
          "[run][failure]") {
    const run::Scene<2> scene = coarse_and_fine();
    Witness witness;
    try {
        static_cast<void>(run::simulate<2>(scene, unstable_options(scene), witness));
        FAIL("it is unstable");
    } catch (const abut::Diverged& error) {
        REQUIRE(error.facts().cell >= 0);
        CHECK(scene.mesh.cell_body[static_cast<std::size_t>(error.facts().cell)] == 1);
        CHECK(std::string(error.what()).find("of body 'fine' at (9.") != std::string::npos);
        CHECK(witness.cells == std::vector{static_cast<std::int32_t>(error.facts().cell)});
    }
    CHECK(witness.failures == 1);
    CHECK(witness.sound.steps > 0);
    CHECK(witness.sound.steps < witness.lost.steps);
    CHECK(fastest(witness.lost) > 10.0 * fastest(witness.sound));
}

TEST_CASE("an observer that fails to look at a failure hides neither the error nor the failure from others",
          "[run][failure]") {
    struct Clumsy : run::Observer<2> {
        void fail(const run::Failure&, const run::Sight<2>&) override { throw std::bad_alloc(); }
    } clumsy;
    const run::Scene<2> scene = coarse_and_fine();
    Witness witness;
    run::Observers<2> both{clumsy, witness};
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, unstable_options(scene), both)), abut::Diverged);
    CHECK(witness.failures == 1);
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, unstable_options(scene), clumsy)), abut::Diverged);
}

TEST_CASE("a step that cannot be ended names the cells whose faces the error names", "[run][failure]") {
    run::RunOptions options;
    options.contact.compression_limit = 1e-3;
    const run::Scene<2> scene = test::block_on_plane(0.1);
    Witness witness;
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, options, witness)), abut::TooDeep);
    CHECK(witness.failures == 1);
    CHECK(witness.lost.q.empty());
    REQUIRE(witness.cells.size() == 1);  // the other face is the plane's
    CHECK(scene.mesh.cell_centroid[static_cast<std::size_t>(witness.cells.front())].y() < 0.5);
}

TEST_CASE("files of a failure can be read back, and go with the next run in that folder", "[run][failure]") {
    const Folder folder;
    const run::Scene<2> scene = coarse_and_fine();
    run::RunOptions options = unstable_options(scene);
    options.out = folder.path();
    options.frames = 0;
    {
        run::ResultFiles<2> files(options, "mine", "blocks");
        CHECK(files.left_behind().empty());
        CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, options, files)), abut::Diverged);
        CHECK(files.left_behind().find("energy.csv.partial") != std::string::npos);
        CHECK(files.left_behind().find("blocks_failed.pvd") != std::string::npos);
    }
    const auto table = lines_of(read_text(folder.path() / "failed.csv"));
    REQUIRE(table.size() == 1 + static_cast<std::size_t>(scene.mesh.n_cells()));
    CHECK(table.front() == "body,cell,x [m],y [m],speed [m/s]");
    CHECK(table.back().starts_with("fine,"));  // the fastest one
    CHECK(fs::exists(folder.path() / "blocks_failed.pvd"));
    CHECK(abut::mesh::read_vtu<2>(folder.path() / "frames/blocks_failed_000000.vtu").n_cells() == scene.mesh.n_cells());
    CHECK(read_text(folder.path() / "frames/blocks_failed_000000.vtu").find("speed when lost [m/s]") != std::string::npos);
    const std::string picture = read_text(folder.path() / "failed.svg");
    for (const char* word : {"Last sound state", "Ring: ", "<circle ", "speed [m/s]", "x [m]"})
        CHECK(picture.find(word) != std::string::npos);
    const std::string page = read_text(folder.path() / "failed.html");
    for (const char* word : {"At the start", "The last sound state", "data:image/png;base64,"})
        CHECK(page.find(word) != std::string::npos);

    options.steps = 1;
    const run::ResultFiles<2> next(options, "mine", "blocks");
    for (const auto& entry : fs::directory_iterator(folder.path()))
        CHECK(entry.path().filename().string().find("failed") == std::string::npos);
}

TEST_CASE("a failure has its pictures also where contact was last searched far from the last sound state",
          "[run][failure]") {
    const Folder folder;
    run::Scene<2> scene = coarse_and_fine();
    scene.contact = true;
    run::RunOptions options = unstable_options(scene);
    options.interval = 5;
    options.contact.search.skin = 1e-3;
    options.out = folder.path();
    options.frames = 0;
    options.animation = 10;
    {
        run::ResultFiles<2> files(options, "mine", "blocks");
        CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, options, files)), abut::Diverged);
        CHECK(files.left_behind().find("could not be written") == std::string::npos);
        CHECK(files.left_behind().find("animation.html.partial") != std::string::npos);
    }
    CHECK(read_text(folder.path() / "failed.html").find("The last sound state") != std::string::npos);
    CHECK(read_text(folder.path() / "animation.html.partial").find("class=\"frame\"") != std::string::npos);
}

TEST_CASE("of a sound state that cannot be evaluated displacements and velocities are shown, and the reason",
          "[run][failure]") {
    const Folder folder;
    run::Scene<2> scene = coarse_and_fine();
    scene.displacement = {};
    scene.velocity = {Vector<2>(0.25, 0.0), Vector<2>(-0.25, 0.0)};
    scene.contact = true;
    scene.time = 20.0;  // they would meet at 16
    run::RunOptions options{.out = folder.path(), .interval = 1, .frames = 0};
    options.contact.search.skin = 0.5;
    options.contact.search.limits.pairs = 1;  // fewer than there are faces that come near
    Witness witness;
    run::ResultFiles<2> files(options, "mine", "blocks");
    run::Observers<2> both{files, witness};
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, options, both)), abut::LimitExceeded);
    REQUIRE(witness.failures == 1);
    CHECK(witness.not_evaluated.find("1 are allowed") != std::string::npos);
    CHECK(witness.stress.empty());
    const auto n_cells = static_cast<std::size_t>(scene.mesh.n_cells());
    REQUIRE(witness.displacement.size() == n_cells);
    REQUIRE(witness.velocity.size() == n_cells);
    REQUIRE(witness.sound.time > 0.0);
    for (std::size_t c = 0; c < n_cells; ++c) {  // nothing has touched them
        const Vector<2>& velocity = scene.velocity[static_cast<std::size_t>(scene.mesh.cell_body[c])];
        CHECK((witness.velocity[c] - velocity).norm() <= 1e-14);
        CHECK((witness.displacement[c] - witness.sound.time * velocity).norm() <= 1e-14 * witness.sound.steps);
    }
    CHECK(files.left_behind().find("blocks_failed.pvd") != std::string::npos);
    CHECK(files.left_behind().find("failed.html is left out, since the stresses of that state could not be evaluated: " +
                                   witness.not_evaluated) != std::string::npos);
    CHECK(fs::exists(folder.path() / "failed.csv"));
    CHECK_FALSE(fs::exists(folder.path() / "failed.html"));
}
