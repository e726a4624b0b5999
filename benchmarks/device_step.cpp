// One step of the bulk on the device of Kokkos (StepDevice) against one on the host, and two blocks that collide on both.
//
// Mesh: a structured box of tetrahedra or hexahedra, free, one material. Step: position update, force at the midpoint, momentum
// update of MEMM; on the device the force alone, displacements go there and forces come back. The bits of both must be the same,
// else nothing is timed. Wall-clock time, all threads unless --threads says otherwise.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <random>
#include <stdexcept>

#include "abut/dynamics/memm.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using solid::StepDevice;

struct Choices {
    std::vector<int> edges{24, 48};
    int repetitions = 15;
    int steps = 400;
    int threads = 0;
    std::string shape = "tetrahedra";
    std::string json;
};

const solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};

std::vector<double> random_field(std::size_t n, double size) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> value(-size, size);
    std::vector<double> field(n);
    for (double& x : field) x = value(generator);
    return field;
}

void require_same_bits(const std::string& what, std::span<const double> host, std::span<const double> device) {
    std::size_t n = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < host.size(); ++i)
        if (std::memcmp(&host[i], &device[i], sizeof host[i]) != 0) {
            ++n;
            largest = std::max(largest, std::abs(host[i] - device[i]));
        }
    if (n > 0)
        throw std::runtime_error(fmt::format("{}: the device and the host differ in {} of {} numbers, by {:.2e} at most",
                                             what, n, host.size(), largest));
}

mesh::CellShape shape_of(const Choices& choices) {
    return choices.shape == "hexahedra" ? mesh::CellShape::hexahedron : mesh::CellShape::tetrahedron;
}

mesh::Mesh<3> block(const Vector<3>& corner, double length, int edge, mesh::CellShape shape) {
    return mesh::structured_box<3>(corner, corner + Vector<3>::Constant(length), {edge, edge, edge}, shape);
}

/// A solid on one device, and its integrator.
struct OnDevice {
    solid::Solid<3> solid;
    dynamics::Memm<solid::Solid<3>> memm;

    OnDevice(const mesh::Mesh<3>& mesh, StepDevice device, bool contact, const std::vector<double>& momentum, double dt)
        : solid(mesh, options(mesh, device, contact)),
          memm(solid, std::vector<double>(solid.size(), 0.0), std::vector<double>(momentum), dt) {}

    static solid::SolidOptions<3> options(const mesh::Mesh<3>& mesh, StepDevice device, bool contact) {
        solid::SolidOptions<3> options;
        options.materials.assign(static_cast<std::size_t>(mesh.n_bodies()), material);
        options.device = device;
        if (contact) options.contact.emplace();
        return options;
    }
};

nlohmann::json measure(int edge, const Choices& choices) {
    const auto mesh = block(Vector<3>::Zero(), 1.0, edge, shape_of(choices));
    const auto momentum = random_field(3 * static_cast<std::size_t>(mesh.n_cells()), 1e-3);
    const double dt = 0.01 / edge;
    OnDevice host(mesh, StepDevice::host, false, momentum, dt), device(mesh, StepDevice::kokkos, false, momentum, dt);
    for (int i = 0; i < 3; ++i) host.memm.step(), device.memm.step();
    require_same_bits("momenta", host.memm.p_after(), device.memm.p_after());

    std::vector<double> force(momentum.size());
    const auto u = as_vectors<3>(std::span<const double>(momentum));
    const auto result = as_vectors<3>(std::span<double>(force));
    const auto samples = benchmark::time_in_turn(
        choices.repetitions, benchmark::Clock::wall,
        {[&] { host.memm.step(); }, [&] { device.memm.step(); }, [&] { host.solid.ccg().step_gradient(u, {}, {}, result); },
         [&] { device.solid.ccg().step_gradient(u, {}, {}, result); }});
    const double per_cell = 1e9 / mesh.n_cells();
    const auto ns = [&](const benchmark::Samples& s) { return per_cell * s.least(); };
    fmt::print(
        "{:>9} cells: step {:7.2f} ns per cell on the host, {:7.2f} on the device ({:.1f} times); forces {:7.2f}, {:7.2f}\n",
        mesh.n_cells(), ns(samples[0]), ns(samples[1]), samples[0].least() / samples[1].least(), ns(samples[2]),
        ns(samples[3]));
    return {{"cells", mesh.n_cells()},
            {"ns_per_cell",
             {{"host_step", ns(samples[0])},
              {"device_step", ns(samples[1])},
              {"host_forces", ns(samples[2])},
              {"device_forces", ns(samples[3])}}}};
}

nlohmann::json collide(const Choices& choices) {
    constexpr int edge = 8;
    constexpr double speed = 0.05;
    const std::array blocks{block(Vector<3>::Zero(), 1.0, edge, shape_of(choices)),
                            block(Vector<3>(1.01, 0.2, 0.1), 1.0, edge + 1, shape_of(choices))};
    const auto mesh = mesh::combine<3>(blocks);
    std::vector<double> momentum(3 * static_cast<std::size_t>(mesh.n_cells()), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        momentum[3 * static_cast<std::size_t>(c)] = (mesh.cell_body[c] == 0 ? speed : -speed) * mesh.cell_measure[c];
    const double dt = 0.02 / edge;
    OnDevice host(mesh, StepDevice::host, true, momentum, dt), device(mesh, StepDevice::kokkos, true, momentum, dt);
    for (int i = 0; i < choices.steps; ++i) host.memm.step(), device.memm.step();
    require_same_bits("displacements of a collision", host.memm.q(), device.memm.q());
    require_same_bits("momenta of a collision", host.memm.p_after(), device.memm.p_after());
    const auto pairs = device.solid.contact().report().active_pairs_max;
    if (pairs == 0) throw std::runtime_error("the blocks did not meet: take more --steps");
    fmt::print("two blocks, {} cells, {} steps, {} pairs in contact at most: the same bits\n", mesh.n_cells(), choices.steps,
               pairs);
    return {{"cells", mesh.n_cells()}, {"steps", choices.steps}, {"active_pairs_max", pairs}};
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Steps on the device of Kokkos against those on the host: bits and times.");
    options.add("--edges", choices.edges, "boxes along an edge of the block, for each mesh");
    options.add("--repetitions", choices.repetitions, "of each measurement");
    options.add("--steps", choices.steps, "of the collision");
    options.add("--threads", choices.threads, "of the host, at most; 0: all");
    options.add("--shape", choices.shape, "of the cells").one_of({"tetrahedra", "hexahedra"});
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    std::optional<oneapi::tbb::global_control> threads;
    if (choices.threads > 0)
        threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(choices.threads));
    nlohmann::json result = benchmark::circumstances(argc, argv);
    result["device"] = solid::kokkos_device();
    fmt::print("device of Kokkos: {}\n", solid::kokkos_device());
    for (const int edge : choices.edges) result["steps"].push_back(measure(edge, choices));
    result["collision"] = collide(choices);
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
