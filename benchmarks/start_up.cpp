// What stands between a mesh file and the first step: time and memory of each part, in steps of the bulk and in bytes a cell.
//
// Two boxes of tetrahedra that face each other, cut irregularly and finer where they will meet, so that local steps have
// several levels. No Gmsh. Each part runs once, as in a program; the step of the bulk is the least of some.
// Expected: no part takes longer than 20 steps of the bulk, none but the file holds more at its peak than what stays.
#include <fmt/core.h>
#include <malloc.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include "abut/dynamics/memm.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/local_steps.hpp"
#include "abut/solid/solid.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using solid::Solid;

struct Choices {
    double cells = 1e5;
    double grading = 8.0;
    double jitter = 0.2;
    int threads = 1;
    int steps = 10;
    std::string json;
};

/// A field of /proc/self/status [bytes].
double status(const std::string& field) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(field + ":")) return 1024.0 * std::stod(line.substr(field.size() + 1));
    throw std::runtime_error("/proc/self/status has no " + field);
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

struct Part {
    std::string name;
    double seconds, kept, peak;  ///< memory beyond what was held before [bytes]
};

class Parts {
public:
    explicit Parts(benchmark::Clock clock) : clock_(clock) {}

    template <class Work>
    void run(const std::string& name, const Work& work) {
        malloc_trim(0);
        const double before = status("VmRSS");
        forget_peak();
        const double seconds = benchmark::seconds_of(work, clock_);
        const double peak = status("VmHWM");
        malloc_trim(0);
        parts_.push_back({name, seconds, status("VmRSS") - before, peak - before});
    }
    [[nodiscard]] const std::vector<Part>& all() const { return parts_; }

private:
    benchmark::Clock clock_;
    std::vector<Part> parts_;
};

/// A box from x = 0 to `side` (1 or -1), its layers along x `grading` times thinner at 0 than at the other end, the inner
/// vertices moved by up to `jitter` of a brick. As a file has it.
mesh::CellSoup<3> soup_of_box(double side, int n, const Choices& choices) {
    const auto box =
        mesh::structured_box<3>({0, 0, 0}, {1, 1, 1}, {n, n, n}, mesh::CellShape::tetrahedron, "box", {.reorder = false});
    mesh::CellSoup<3> soup;
    soup.name = side < 0.0 ? "left" : "right";
    soup.body_names = {soup.name};
    soup.cell_shape = box.cell_shape;
    soup.cell_vertices = box.cell_vertices;
    soup.cell_body = box.cell_body;
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> move(-choices.jitter / n, choices.jitter / n);
    const auto inner = [](double x) { return x > 1e-9 && x < 1.0 - 1e-9; };
    for (Vector<3> x : box.vertices) {
        for (int d = 0; d < 3; ++d)
            if (inner(x[d])) x[d] += move(random);
        if (choices.grading > 1.0) x[0] = std::expm1(std::log(choices.grading) * x[0]) / (choices.grading - 1.0);
        soup.vertices.push_back({side * (x[0] + 1e-3), x[1], x[2]});
    }
    if (side > 0.0) return soup;
    for (std::size_t c = 0; c < soup.cell_shape.size(); ++c)  // the mirror turns cells inside out
        std::swap(soup.cell_vertices.values[4 * c], soup.cell_vertices.values[4 * c + 1]);
    return soup;
}

solid::SolidOptions<3> options(bool with_contact) {
    solid::SolidOptions<3> options;
    options.materials.assign(2, {.young = 1.0, .poisson = 0.3, .density = 1.0});
    if (with_contact) options.contact.emplace();
    return options;
}

/// Least of some steps [s].
template <class Scheme>
double step_seconds(Scheme& scheme, int steps, benchmark::Clock clock) {
    benchmark::Samples samples;
    for (int i = 0; i < steps; ++i) samples.seconds.push_back(benchmark::seconds_of([&] { scheme.step(); }, clock));
    return samples.least();
}

struct Run {
    std::int32_t n_cells = 0;
    std::vector<std::int64_t> level_cells;
    double bulk_step = 0.0;   ///< [s]
    double bulk_bytes = 0.0;  ///< held by mesh, operators and scheme of a run without contact
    std::vector<Part> parts;
};

mesh::Mesh<3> build(Parts& parts, const Choices& choices) {
    const int n = static_cast<int>(std::lround(std::cbrt(choices.cells / 12.0)));
    std::vector<mesh::Mesh<3>> boxes;
    auto left = soup_of_box(-1.0, n, choices), right = soup_of_box(1.0, n + 1, choices);
    parts.run("faces, measures, checks, order (build_mesh)", [&] {
        boxes.push_back(mesh::build_mesh(std::move(left)));
        boxes.push_back(mesh::build_mesh(std::move(right)));
    });
    mesh::Mesh<3> both;
    parts.run("two meshes in one (combine)", [&] { both = mesh::combine<3>(boxes); });
    boxes.clear();
    return both;
}

void read(Parts& parts, const mesh::Mesh<3>& both) {
    const auto file = std::filesystem::temp_directory_path() / fmt::format("abut_start_up_{}.vtu", getpid());
    mesh::write_vtu(both, file);
    std::optional<mesh::Mesh<3>> again;
    parts.run("the same from a .vtu file", [&] { again = mesh::read_mesh<3>(file); });
    std::filesystem::remove(file);
    if (again->n_cells() != both.n_cells()) throw std::runtime_error("the file has other cells than were written.");
}

Run measure(const Choices& choices) {
    const auto clock = benchmark::clock_for(choices.threads);
    Parts parts(clock);
    Run run;
    const double before = status("VmRSS");
    const mesh::Mesh<3> both = build(parts, choices);
    run.n_cells = both.n_cells();
    {
        std::optional<Solid<3>> free;
        parts.run("operators of the bulk (Solid, no contact)", [&] { free.emplace(both, options(false)); });
        const std::vector<double> rest(free->size(), 0.0);
        const auto p = solid::uniform_momentum<3>(*free, std::vector<Vector<3>>{{0.1, 0.0, 0.0}, {-0.1, 0.0, 0.0}});
        dynamics::Memm scheme(*free, rest, p, 1e-6 / std::cbrt(run.n_cells));
        run.bulk_step = step_seconds(scheme, choices.steps, clock);
        run.bulk_bytes = status("VmRSS") - before;
    }
    parts.run("no cells inside each other (check_apart)", [&] { mesh::check_apart(both); });
    std::optional<Solid<3>> solid;
    parts.run("operators and contact (Solid)", [&] { solid.emplace(both, options(true)); });
    dynamics::StableStep stable{};
    parts.run("stable step", [&] { stable = dynamics::stable_step(*solid); });
    std::optional<solid::SolidLocalSteps> local;
    parts.run("levels of local steps", [&] { local = solid::local_steps(*solid, stable); });
    run.level_cells = local->cells;
    const std::vector<double> rest(solid->size(), 0.0);
    const auto p = solid::uniform_momentum<3>(*solid, std::vector<Vector<3>>{{0.1, 0.0, 0.0}, {-0.1, 0.0, 0.0}});
    {
        std::optional<dynamics::Memm<Solid<3>>> scheme;
        parts.run("first force (Memm)", [&] { scheme.emplace(*solid, rest, p, 0.9 * stable.dt); });
        parts.run("first step", [&] { scheme->step(); });
    }
    solid.emplace(both, options(true));  // a run goes from step to step: another one, another solid
    {
        std::optional<dynamics::MemmAsync<Solid<3>>> scheme;
        parts.run("first force of local steps (MemmAsync)",
                  [&] { scheme.emplace(*solid, rest, p, 0.9 * local->dt, local->steps); });
        parts.run("first of the longest local steps", [&] { scheme->step(); });
    }
    solid.reset();
    read(parts, both);
    run.parts = parts.all();
    return run;
}

nlohmann::json report(const Run& run) {
    const double n = run.n_cells;
    fmt::print(
        "{} cells, {} levels; a step of the bulk: {:.1f} ms, {:.0f} ns a cell; a run without contact holds {:.0f} bytes "
        "a cell\n{:<46} {:>8} {:>8} {:>12} {:>12} {:>14}\n",
        run.n_cells, run.level_cells.size(), 1e3 * run.bulk_step, 1e9 * run.bulk_step / n, run.bulk_bytes / n, "", "s",
        "steps", "kept, B/cell", "peak, B/cell", "peak / that run");
    nlohmann::json result{{"cells", run.n_cells},
                          {"level_cells", run.level_cells},
                          {"bulk_step_s", run.bulk_step},
                          {"bulk_bytes", run.bulk_bytes}};
    for (const Part& part : run.parts) {
        fmt::print("{:<46} {:>8.3f} {:>8.1f} {:>12.0f} {:>12.0f} {:>14.2f}\n", part.name, part.seconds,
                   part.seconds / run.bulk_step, part.kept / n, part.peak / n, part.peak / run.bulk_bytes);
        result["parts"].push_back({{"name", part.name},
                                   {"seconds", part.seconds},
                                   {"steps", part.seconds / run.bulk_step},
                                   {"kept_bytes", part.kept},
                                   {"peak_bytes", part.peak}});
    }
    return result;
}

int run_benchmark(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Time and memory from a mesh to the first step, part by part.");
    options.add("--cells", choices.cells, "of both boxes, about").between(1e3, 1e8);
    options.add("--grading", choices.grading, "thickest over thinnest layer").between(1.0, 1e3);
    options.add("--jitter", choices.jitter, "of inner vertices, over the size of a brick").between(0.0, 0.3);
    options.add("--steps", choices.steps, "of the bulk; the least counts").positive();
    options.add("--threads", choices.threads).positive();
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    nlohmann::json result = benchmark::circumstances(argc, argv);
    result.update(report(measure(choices)));
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return benchmark::main(argc, argv, run_benchmark); }
