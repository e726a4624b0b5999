#include "support/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

namespace abut::examples {
namespace {

using Json = nlohmann::ordered_json;

template <int Dim>
Json to_json(const Vector<Dim>& vector) {
    return Json(std::vector<double>(vector.begin(), vector.end()));
}

template <int Dim>
double kinetic_initial(const RunResult<Dim>& result) {
    return result.ledger.entries().front().kinetic;
}

/// Time in contact, search included, over the time of the bulk [-].
template <int Dim>
double contact_share(const RunResult<Dim>& result) {
    return (result.times.contact + result.times.search) / result.times.bulk;
}

template <int Dim>
Json bodies_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Json bodies = Json::array();
    for (std::size_t body = 0; body < result.start.size(); ++body)
        bodies.push_back({{"name", scene.mesh.body_names[body]},
                          {"mass", result.start[body].mass},
                          {"velocity_initial", to_json<Dim>(result.start[body].velocity)},
                          {"velocity_final", to_json<Dim>(result.end[body].velocity)}});
    return bodies;
}

template <int Dim>
Json seconds_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    return {{"total", scene.mesh_seconds + result.seconds.total}, {"mesh", scene.mesh_seconds},          {"setup", result.seconds.setup},
            {"bulk", result.times.bulk},                          {"contact", result.times.contact},     {"search", result.times.search},
            {"ledger", result.seconds.ledger},                    {"output", result.seconds.output}};
}

template <int Dim>
Json options_json(const Scene<Dim>& scene, const RunOptions& options, const RunResult<Dim>& result) {
    Json all = scene.options;
    all.update(examples::to_json(options));
    all["time"] = scene.time;
    all["dt"] = result.dt;
    if (options.contact.quadrature == 0) all["quadrature"] = Dim;
    return all;
}

template <int Dim>
std::string velocity_text(const Vector<Dim>& velocity) {
    std::vector<std::string> parts;
    for (const double v : velocity) parts.push_back(fmt::format("{:+.6f}", v));
    return fmt::format("({})", fmt::join(parts, ", "));
}

void print_line(const std::string& name, const std::string& value) { fmt::print("  {:<34}{}\n", name, value); }

template <int Dim>
void print_energies(const RunResult<Dim>& result) {
    const double k = kinetic_initial(result);
    print_line("kinetic energy at the start, K0", fmt::format("{:.6g} J", k));
    print_line("drift of pseudo-energy, / K0", fmt::format("{:.2e}", result.ledger.pseudo_energy_drift() / k));
    print_line("energy excess H - H~, / K0", fmt::format("{:.2e}", result.ledger.energy_excess() / k));
    print_line("parasitic mode, max |e|/m", fmt::format("{:.2e} m/s", result.ledger.parasitic()));
    print_line("drift of linear momentum", fmt::format("{:.2e} kg m/s", result.ledger.momentum_drift()));
    print_line("drift of angular momentum", fmt::format("{:.2e} kg m^2/s", result.ledger.angular_momentum_drift()));
}

template <int Dim>
void print_contact(const RunResult<Dim>& result) {
    print_line("contact events", fmt::format("{}", result.contact.events));
    print_line("active pairs, at most", fmt::format("{} ({} at the end)", result.contact.active_pairs_max, result.ledger.entries().back().active_pairs));
    print_line("contacts lost", fmt::format("{}", result.contact.lost_contacts));
    print_line("compression of the skin, at most", fmt::format("{:.3g}", result.contact.compression_max));
}

template <int Dim>
void print_files(const RunOptions& options, const RunResult<Dim>& result) {
    const auto path = [&](const char* name) { return (options.out / name).string(); };
    fmt::print("Files\n");
    print_line("energies", path("energy.csv"));
    print_line("summary", path("summary.json"));
    if (options.frames > 0) print_line("for ParaView", path("cylinders.pvd") + ", " + path("cylinders_surface.pvd"));
    print_line("picture", result.without_picture.empty() ? path("energy.png") : "none: " + result.without_picture);
}

}  // namespace

template <int Dim>
Json summary(const Scene<Dim>& scene, const RunOptions& options, const RunResult<Dim>& result) {
    const auto& ledger = result.ledger;
    const auto& contact = result.contact;
    return {{"program", scene.program},
            {"version", ABUT_VERSION},
            {"dim", Dim},
            {"cells", scene.mesh.n_cells()},
            {"boundary_faces", scene.mesh.boundary_faces.size()},
            {"steps", result.steps},
            {"dt", result.dt},
            {"stable_dt", result.stable.dt},
            {"time", ledger.entries().back().time},
            {"kinetic_initial", kinetic_initial(result)},
            {"pseudo_energy_drift", ledger.pseudo_energy_drift()},
            {"energy_excess_max", ledger.energy_excess()},
            {"parasitic_max", ledger.parasitic()},
            {"momentum_drift_max", ledger.momentum_drift()},
            {"angular_momentum_drift_max", ledger.angular_momentum_drift()},
            {"events", contact.events},
            {"active_pairs_max", contact.active_pairs_max},
            {"active_pairs_final", ledger.entries().back().active_pairs},
            {"lost_contacts", contact.lost_contacts},
            {"candidates", result.candidates_max},
            {"rebuilds", contact.rebuilds},
            {"compression_max", contact.compression_max},
            {"compressed_steps", contact.compressed_steps},
            {"stencil_faces", result.stencils.faces},
            {"stencil_extrapolations", result.stencils.extrapolated},
            {"stencil_worst_weight", result.stencils.worst_weight},
            {"bodies", bodies_json(scene, result)},
            {"seconds", seconds_json(scene, result)},
            {"contact_share", contact_share(result)},
            {"options", options_json(scene, options, result)}};
}

template <int Dim>
void print_table(const Scene<Dim>& scene, const RunOptions& options, const RunResult<Dim>& result) {
    fmt::print("{}: {} cells, {} steps of {:.4g} s ({:.3g} of the stable step)\n", scene.program, scene.mesh.n_cells(), result.steps, result.dt,
               result.dt / result.stable.dt);
    print_energies(result);
    print_contact(result);
    for (std::size_t body = 0; body < result.end.size(); ++body)
        print_line(fmt::format("velocity of '{}'", scene.mesh.body_names[body]),
                   fmt::format("{} -> {} m/s", velocity_text<Dim>(result.start[body].velocity), velocity_text<Dim>(result.end[body].velocity)));
    print_line("time of the run", fmt::format("{:.1f} s: mesh {:.1f}, setup {:.1f}, bulk {:.1f}, contact {:.2f}, search {:.2f}, ledger {:.1f}, output {:.1f}",
                                              scene.mesh_seconds + result.seconds.total, scene.mesh_seconds, result.seconds.setup, result.times.bulk,
                                              result.times.contact, result.times.search, result.seconds.ledger, result.seconds.output));
    print_files(options, result);
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template Json summary<Dim>(const Scene<Dim>&, const RunOptions&, const RunResult<Dim>&);              \
    template void print_table<Dim>(const Scene<Dim>&, const RunOptions&, const RunResult<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::examples
