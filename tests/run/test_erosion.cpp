// Cells that leave a run of a scene.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/files/probes.hpp"
#include "abut/run/files/run_identity.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/values/sight.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/warnings.hpp"
#include "abut/solid/cell_view.hpp"
#include "run/folder.hpp"
#include "support/keep.hpp"

namespace {

using namespace abut;
using solid::Kinematics;

constexpr double h = 0.05;  // size of cells [m]; E = 1 Pa and rho = 1 kg/m^3 throughout, so that waves in bars have 1 m/s

/// A bar along x from 0, `n` cells long and three cells across, without contraction.
template <int Dim>
run::Scene<Dim> bar(int n, Kinematics kinematics) {
    Vector<Dim> upper = Vector<Dim>::Constant(3.0 * h);
    upper[0] = n * h;
    std::array<int, Dim> counts;
    counts.fill(3);
    counts[0] = n;
    const auto shape = Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron;
    run::Scene<Dim> scene;
    scene.mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, counts, shape, "bar");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.solid.kinematics = {kinematics};
    scene.velocity = {Vector<Dim>::Zero()};
    return scene;
}

/// Momentum of the cells left and right of a plane across x, at each step; it counts the steps after which cells left.
template <int Dim>
class Halves : public run::Observer<Dim> {
public:
    explicit Halves(double middle) : middle_(middle) {}
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        left = right = Vector<Dim>::Zero();
        const auto before = solid.cells().velocity(run.p_before), after = solid.cells().velocity(run.p_after);
        for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
            const auto i = static_cast<std::size_t>(c);
            (solid.mesh().cell_centroid[i][0] < middle_ ? left : right) +=
                0.5 * solid.mesh().cell_measure[i] * (before[i] + after[i]);
        }
        if (parted) {
            change = std::max({change, (left - left_when_parted).norm(), (right - right_when_parted).norm()});
        } else if (n_cells != 0 && solid.mesh().n_cells() != n_cells) {
            parted = run.time;
            left_when_parted = left;
            right_when_parted = right;
        }
        n_cells = solid.mesh().n_cells();
    }

    Vector<Dim> left, right, left_when_parted, right_when_parted;
    std::optional<double> parted;  // [s]
    double change = 0.0;           // of either half since then [kg m/s]
    std::int32_t n_cells = 0;

private:
    double middle_;
};

/// A block that flies at a plate, two cells thick and in space three; nothing is held.
template <int Dim>
run::Scene<Dim> block_and_plate(Kinematics of_plate) {
    run::Scene<Dim> scene;
    constexpr int n = Dim == 2 ? 24 : 8, layers = Dim == 2 ? 2 : 3;
    const double half = 0.5 * n * h;
    Vector<Dim> low = Vector<Dim>::Constant(-half), high = Vector<Dim>::Constant(half);
    low[0] = 0.0;
    high[0] = layers * h;
    std::array<int, Dim> counts;
    counts.fill(n);
    counts[0] = layers;
    const auto shape = Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron;
    Vector<Dim> from = Vector<Dim>::Constant(-0.1), to = Vector<Dim>::Constant(0.1);
    from[0] = -0.21;
    to[0] = -0.01;
    std::array<int, Dim> of_block;
    of_block.fill(3);
    scene.mesh = mesh::combine<Dim>(std::vector{mesh::structured_box<Dim>(from, to, of_block, shape, "block"),
                                                mesh::structured_box<Dim>(low, high, counts, shape, "plate")});
    scene.solid.materials = {{.young = 4.0, .poisson = 0.3, .density = 4.0}, {.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.solid.kinematics = {Kinematics::floating, of_plate};
    scene.solid.erosion = {{}, {.strain = Dim == 2 ? 0.15 : 0.25}};
    scene.velocity = {0.3 * Vector<Dim>::UnitX(), Vector<Dim>::Zero()};
    scene.time = 3.0;
    return scene;
}

template <int Dim>
void check_balance(const run::RunResult<Dim>& result) {
    const double scale = result.energy.accounts.energy_in_play;
    const double momentum = result.energy.accounts.speed * result.bodies.start[0].mass;
    CHECK(result.ledger.pseudo_energy_drift() <= 1e-12 * scale);
    CHECK(result.energy.accounts.momentum_drift <= 1e-13 * momentum);
    CHECK(result.contact.report.missed_contacts == 0);
}

/// Asks to stop after some step.
class StopAtStep : public run::Observer<2> {
public:
    explicit StopAtStep(std::int64_t step) : step_(step) {}
    void look(const dynamics::RunView<2>& view, solid::Solid<2>&) override { now_ = view.steps + 1; }
    [[nodiscard]] bool asks_to_stop() const override { return now_ == step_; }

private:
    std::int64_t step_;
    std::int64_t now_ = 0;
};

/// The first and the last values of the probes of a scene.
class Probing : public run::Observer<2> {
public:
    void begin(const run::Scene<2>& scene, const run::RunResult<2>& result) override {
        probes_ = run::Probes<2>(scene, result);
    }
    void cells_left(const solid::Solid<2>&, std::span<const std::int32_t> first_cells) override {
        probes_.take_cells(first_cells);
    }
    void look(const dynamics::RunView<2>& view, solid::Solid<2>& solid) override {
        last = probes_.values(run::sight_of<2>(view, solid));
        if (view.steps == 0) first = last;
        time = view.time;
    }

    std::vector<std::vector<double>> first, last;
    double time = 0.0;  // of the last ones [s]

private:
    run::Probes<2> probes_;
};

/// With probes at the plate and of all of it.
run::Scene<2> watched_block_and_plate() {
    run::Scene<2> scene = block_and_plate<2>(Kinematics::small);
    scene.outputs.probes = {{.name = "middle", .body = 1, .position = Vector<2>(0.5 * h, 0.5 * h)},
                            {.name = "plate", .body = 1}};
    scene.outputs.forces = true;
    return scene;
}

template <int Dim>
std::string message_of(const run::Scene<Dim>& scene, const run::RunOptions& options) {
    try {
        static_cast<void>(run::simulate<Dim>(scene, options));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a bar that is torn apart flies on in halves that keep the momentum they had when it parted",
                       "[run][erosion]", ((int Dim), Dim), 2, 3) {
    // Its halves fly apart by v each: the middle is under rho c v from the first step on, and more than the limit.
    constexpr int n = 21;
    constexpr double v = 0.02, middle = 0.5 * n * h;
    run::Scene<Dim> scene = bar<Dim>(n, Kinematics::small);
    scene.added_velocity = [](const Vector<Dim>& x) -> Vector<Dim> {
        return (std::abs(x[0] - middle) < 0.4 * h ? 0.0 : x[0] < middle ? -v : v) * Vector<Dim>::UnitX();
    };
    scene.solid.erosion = {{.stress = 0.7 * v}};
    scene.time = 2.0;
    Halves<Dim> halves(middle);
    const run::RunResult<Dim> result = run::simulate<Dim>(scene, {}, halves);

    REQUIRE(halves.parted);
    const double cell = std::pow(h, Dim), whole = scene.mesh.n_cells() * cell;
    CHECK(std::ssize(result.erosion.cells) == (Dim == 2 ? 3 : 9));  // those of the middle
    CHECK(result.erosion.left.mass == Approx(std::ssize(result.erosion.cells) * cell).epsilon(1e-12));
    // Each half has been pulled back with the force in the middle, at most rho c v A, until then.
    const double half_mass = 0.5 * (whole - result.erosion.left.mass), area = std::pow(3.0 * h, Dim - 1);
    const double pulled_back = half_mass * v - halves.right_when_parted[0];
    CHECK(pulled_back > 0.0);
    CHECK(pulled_back < v * area * *halves.parted);
    CHECK((halves.right_when_parted + halves.left_when_parted).norm() <= 1e-15);
    CHECK(halves.change <= 1e-14 * half_mass * v);
    CHECK(result.ledger.pseudo_energy_drift() <= 1e-12 * result.energy.accounts.energy_in_play);
    CHECK(result.energy.accounts.momentum_drift <= 1e-14 * half_mass * v);
}

TEST_CASE("a wave of compression that comes back from a free end tears it off where and when theory says",
          "[run][erosion]") {
    // A pulse of stress -p sin^2(pi s/l), s behind its front. At x from the end, tau after its front has met the end, it is under
    // -p sin(2 pi tau/l) sin(2 pi x/l): largest at x = l/4, and there at the limit when -sin(2 pi tau/l) = limit/p.
    constexpr int n = 160;
    constexpr double length = n * h, p = 0.02, l = 2.0, limit = 0.6 * p, front = length - 1.0, pi = std::numbers::pi;
    run::Scene<2> scene = bar<2>(n, Kinematics::small);
    const auto behind = [](const Vector<2>& x) { return std::min(std::max(front - x[0], 0.0), l + 0.0); };
    scene.displacement = [behind](const Vector<2>& x) -> Vector<2> {
        const double s = behind(x);
        return p * (0.5 * s - l / (4.0 * pi) * std::sin(2.0 * pi * s / l)) * Vector<2>::UnitX();
    };
    scene.added_velocity = [behind](const Vector<2>& x) -> Vector<2> {
        return p * std::pow(std::sin(pi * behind(x) / l), 2) * Vector<2>::UnitX();
    };
    scene.solid.erosion = {{.stress = limit}};
    const double time = 1.0 + l * (0.5 + std::asin(limit / p) / (2.0 * pi));
    scene.time = time + 0.2;
    const run::RunResult<2> result = run::simulate<2>(scene);
    REQUIRE(result.erosion.cells.size() >= 3);
    const run::ErodedCell& first = result.erosion.cells.front();
    CHECK(first.time == Approx(time).margin(h));  // a step is 0.9 h
    double sum = 0.0;
    int n_first = 0;
    for (const run::ErodedCell& one : result.erosion.cells) {
        CHECK(one.reason != solid::LeavingReason::strain);
        if (one.step != first.step) continue;
        sum += length - scene.mesh.cell_centroid[static_cast<std::size_t>(one.cell)][0];
        ++n_first;
    }
    CHECK(n_first % 3 == 0);  // across the bar
    CHECK(sum / n_first == Approx(l / 4.0).margin(h));
}

TEMPLATE_TEST_CASE_SIG("a block goes through a plate, and energy and momentum are kept with what left", "[run][erosion]",
                       ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    const run::Scene<Dim> scene = block_and_plate<Dim>(kinematics);
    const run::RunResult<Dim> result = run::simulate<Dim>(scene);
    check_balance(result);
    if (kinematics == Kinematics::finite)  // nothing has directions of its own in space
        CHECK(result.ledger.pseudo_angular_momentum_drift() <=
              1e-13 * result.energy.moment_scale * std::sqrt(result.energy.accounts.energy_in_play));
    CHECK(result.erosion.cells.size() > 4);
    CHECK(result.bodies.end[0].velocity[0] > 0.0);
    CHECK(result.bodies.end[0].velocity[0] < 0.3);
    CHECK(result.ledger.entries().back().active_pairs == 0);  // it is through
    for (const run::ErodedCell& one : result.erosion.cells)
        CHECK(scene.mesh.cell_body[static_cast<std::size_t>(one.cell)] == 1);
}

TEMPLATE_TEST_CASE_SIG("a run that goes on after cells have left is bitwise that which was not stopped", "[run][erosion]",
                       ((int Dim), Dim), 2, 3) {
    const run::Scene<Dim> scene = block_and_plate<Dim>(Kinematics::small);
    run::RunOptions options;
    run::Observer<Dim> nobody;
    const run::RunResult<Dim> whole = run::simulate<Dim>(scene, options, nobody);
    const auto& cells = whole.erosion.cells;
    REQUIRE(cells.front().step < cells.back().step);
    test::Keep<Dim> keep((cells.front().step + cells.back().step) / 2);
    static_cast<void>(run::simulate<Dim>(scene, options, keep));
    REQUIRE(keep.kept);
    const run::RunResult<Dim> rest = run::simulate<Dim>(scene, options, nobody, &*keep.kept);
    CHECK(rest.run.resumed_after > cells.front().step);
    REQUIRE(rest.erosion.cells.size() == cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        CHECK(rest.erosion.cells[i].cell == cells[i].cell);
        CHECK(rest.erosion.cells[i].step == cells[i].step);
    }
    REQUIRE(rest.ledger.entries().size() == whole.ledger.entries().size());
    CHECK(dynamics::ledger_values(rest.ledger.entries().back()) == dynamics::ledger_values(whole.ledger.entries().back()));
}

TEST_CASE("files of a run that was stopped after cells had left are those of the run that was not", "[run][erosion]") {
    const test::Folder folder;
    const run::Scene<2> scene = watched_block_and_plate();
    run::RunOptions options{.interval = 10, .frames = 6, .animation = 5};
    options.format = GENERATE(run::FrameFormat::vtu, run::FrameFormat::xdmf);
    const auto go = [&](const std::string& name, std::int64_t stop_after) {
        options.out = folder.path() / name;
        run::ResultFiles<2> files(options, "erosion", "bodies");
        StopAtStep stop(stop_after);
        run::Observers<2> observers{files, stop};
        std::optional<run::Checkpoint> from;
        if (options.resume) from = files.last_checkpoint().checkpoint;
        run::RunResult<2> result = run::simulate<2>(scene, options, observers, from ? &*from : nullptr);
        files.finish(scene, result);
        return result;
    };
    const run::RunResult<2> whole = go("whole", -1);
    const std::int64_t first = whole.erosion.cells.front().step, last = whole.erosion.cells.back().step;
    REQUIRE(first < last);
    CHECK_FALSE(go("in_parts", (first + last) / 2).run.complete);
    options.resume = true;
    CHECK_FALSE(go("in_parts", last + 5).run.complete);
    CHECK(go("in_parts", -1).run.complete);
    int n_compared = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "whole")) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".csv" && extension != ".vtu" && extension != ".xmf" && extension != ".html") continue;
        if (entry.path().filename() == "report.html") continue;  // with times
        CAPTURE(entry.path());
        const auto other = folder.path() / "in_parts" / std::filesystem::relative(entry.path(), folder.path() / "whole");
        CHECK((test::read_text(entry.path()) == test::read_text(other)));
        ++n_compared;
    }
    CHECK(n_compared >= 5);
}

TEST_CASE("a probe of a body is the mean over what is left, and one at a place is none once its cell has left",
          "[run][erosion]") {
    const test::Folder folder;
    run::Scene<2> scene = bar<2>(12, Kinematics::small);
    scene.velocity = {Vector<2>(0.1, 0.0)};
    scene.time = 0.5;
    const Vector<2> place(6.5 * h, 1.5 * h), other(3.5 * h, 1.5 * h);
    scene.outputs.probes = {{.name = "place", .body = 0, .position = place},
                            {.name = "other", .body = 0, .position = other},
                            {.name = "bar", .body = 0}};
    scene.leaving = [&](const dynamics::RunView<2>& run, solid::Solid<2>& solid) {
        std::vector<std::int32_t> cells;
        for (std::int32_t c = 0; run.steps == 3 && c < solid.mesh().n_cells(); ++c)
            if ((solid.mesh().cell_centroid[static_cast<std::size_t>(c)] - place).norm() < 0.1 * h) cells.push_back(c);
        return cells;
    };
    Probing probing;
    const run::RunResult<2> result = run::simulate<2>(scene, {}, probing);
    REQUIRE(result.erosion.cells.size() == 1);
    REQUIRE(probing.last.size() == 3);
    CHECK(std::isnan(probing.last[0][0]));
    CHECK(probing.first[0][2] == Approx(0.1).epsilon(1e-13));  // its velocity along x
    for (const std::size_t probe : {1, 2}) {
        CHECK(probing.last[probe][0] == Approx(0.1 * probing.time).epsilon(1e-12));
        CHECK(probing.last[probe][2] == Approx(0.1).epsilon(1e-12));
    }
}

TEST_CASE("cells leave that a function names, and with them those that are too thin to be left", "[run][erosion]") {
    // A bar of 12 x 3 bricks loses two columns, five columns apart from the end: what is left between them is a piece.
    run::Scene<2> scene = bar<2>(12, Kinematics::small);
    scene.velocity = {Vector<2>(0.1, 0.0)};
    scene.time = 1.0;
    const auto is_at = [](const Vector<2>& x, double column) { return std::abs(x[0] - (column + 0.5) * h) < 0.1 * h; };
    scene.leaving = [&](const dynamics::RunView<2>& run, solid::Solid<2>& solid) {
        std::vector<std::int32_t> cells;
        for (std::int32_t c = 0; run.steps == 3 && c < solid.mesh().n_cells(); ++c)
            if (is_at(solid.mesh().cell_centroid[static_cast<std::size_t>(c)], 1.0)) cells.push_back(c);
        return cells;
    };
    const run::RunResult<2> result = run::simulate<2>(scene);
    // The column at the end is a row of bricks.
    REQUIRE(result.erosion.cells.size() == 6);
    for (const run::ErodedCell& one : result.erosion.cells) {
        const bool is_named = is_at(scene.mesh.cell_centroid[static_cast<std::size_t>(one.cell)], 1.0);
        CHECK(one.reason == (is_named ? solid::LeavingReason::function : solid::LeavingReason::remnant));
    }
    CHECK(result.bodies.end[0].velocity[0] == Approx(0.1).epsilon(1e-13));

    scene.leaving = [](const dynamics::RunView<2>&, solid::Solid<2>&) { return std::vector<std::int32_t>{36}; };
    CHECK_THAT(message_of(scene, {}), Catch::Contains("lets cell 36 leave, counted from 0, of 36 cells"));
    scene.leaving = [](const dynamics::RunView<2>& run, solid::Solid<2>& solid) {
        std::vector<std::int32_t> all;
        for (std::int32_t c = 0; run.steps == 2 && c < solid.mesh().n_cells(); ++c) all.push_back(c);
        return all;
    };
    CHECK_THAT(message_of(scene, {}),
               Catch::Contains("step 2,") && Catch::Contains("all that is left of body 'bar' leaves"));
}

TEST_CASE("a run says how much has left, and warns above a hundredth", "[run][erosion]") {
    run::Scene<2> scene = bar<2>(40, Kinematics::small);
    scene.velocity = {Vector<2>(0.1, 0.0)};
    scene.time = 0.5;
    const int n = GENERATE(1, 3);
    scene.leaving = [n](const dynamics::RunView<2>& run, solid::Solid<2>& solid) {
        std::vector<std::int32_t> cells;
        for (std::int32_t c = 0; run.steps == 3 && c < solid.mesh().n_cells() && std::ssize(cells) < n; ++c)
            if (solid.mesh().cell_centroid[static_cast<std::size_t>(c)][0] > h * (20 + 4 * std::ssize(cells)))
                cells.push_back(c);
        return cells;
    };
    const run::RunResult<2> result = run::simulate<2>(scene);
    REQUIRE(std::ssize(result.erosion.cells) == n);
    const auto warnings = run::warnings_after(result);
    const bool warned = std::ranges::any_of(warnings, [](const auto& w) { return w.kind == run::WarningKind::erosion; });
    CHECK(warned == (n == 3));  // of 120 cells that fly alike
    CHECK_THAT(run::closing_table("test", scene, result),
               Catch::Contains(n == 3 ? "3 cells, 2.5 % of the mass, 2.5 % of the energy" : "1 cell, 0.833 % of the mass"));
    CHECK_THAT(run::summary_json("test", scene, result), Catch::Contains("\"mass_share\": 0.0"));
}

TEST_CASE("frames show the cells that are left, with their numbers in the scene", "[run][erosion]") {
    const test::Folder folder;
    const bool as_xdmf = GENERATE(false, true);
    run::RunOptions options{.out = folder.path(), .frames = 4, .animation = 3};
    options.format = as_xdmf ? run::FrameFormat::xdmf : run::FrameFormat::vtu;
    const run::Scene<2> scene = block_and_plate<2>(Kinematics::small);
    run::ResultFiles<2> files(options, "erosion", "bodies");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);
    const auto cells_of = [](const std::string& text) {  // NumberOfCells="12", NumberOfElements="12"
        std::vector<int> counts;
        const std::string key =
            text.find("NumberOfCells=\"") != std::string::npos ? "NumberOfCells=\"" : "NumberOfElements=\"";
        for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
            counts.push_back(std::stoi(text.substr(at + key.size())));
        return counts;
    };
    const int all = scene.mesh.n_cells(), left = all - static_cast<int>(result.erosion.cells.size());
    if (as_xdmf) {
        const auto counts = cells_of(test::read_text(folder.path() / "bodies.xmf"));
        REQUIRE(counts.size() == 4);
        CHECK(counts.front() == all);
        CHECK(counts.back() == left);
    } else {
        CHECK(cells_of(test::read_text(folder.path() / "frames" / "bodies_000000.vtu")).at(0) == all);
        const std::string last = test::read_text(folder.path() / "frames" / "bodies_000003.vtu");
        CHECK(cells_of(last).at(0) == left);
        CHECK_THAT(last, Catch::Contains("\"cell of the scene\""));
    }
    CHECK_THAT(test::read_text(folder.path() / "report.html"), Catch::Contains("cells that left"));
}

TEST_CASE("a checkpoint is of a run with its limits of erosion and its bonds: another one is refused by what differs",
          "[run][erosion][restart]") {
    run::Scene<2> scene = bar<2>(8, Kinematics::floating);
    const run::RunResult<2> result{};
    const auto identity_with = [&](double strain, double strength) {
        scene.solid.erosion = {{.strain = strain}};
        scene.solid.bonds = {{.sides = {0, 1}, .strength = strength}};
        return run::identity<2>(scene, result);
    };
    const std::string saved = identity_with(0.3, 1.0);
    CHECK_NOTHROW(run::require_same_run(saved, identity_with(0.3, 1.0), false));
    CHECK_THROWS_WITH(run::require_same_run(saved, identity_with(0.4, 1.0), false),
                      Catch::Contains("limits of erosion") && Catch::Contains("0.3") && Catch::Contains("0.4"));
    CHECK_THROWS_WITH(run::require_same_run(saved, identity_with(0.3, 2.0), false), Catch::Contains("bonds"));
}
