#include "abut/run/files/run_identity.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/run/files/json.hpp"
#include "abut/run/option_table.hpp"

namespace abut::run {
namespace {

template <int Dim>
std::string checksum(const mesh::Mesh<Dim>& mesh) {
    Checksum sum;
    for (const Vector<Dim>& vertex : mesh.vertices) sum.add_values<double>(std::span(vertex.data(), Dim));
    sum.add_values<std::int32_t>(mesh.cell_vertices.values);
    return fmt::format("{:016x}", sum.value());
}

/// Checksum of what bonds are made of: states remember which broke, and the strengths that were drawn.
template <int Dim>
std::string checksum_of_bonds(const solid::SolidOptions<Dim>& solid) {
    Checksum sum;
    for (const solid::Bond& bond : solid.bonds) {
        sum.add_values<std::int32_t>(bond.sides);
        const std::array values{bond.strength, bond.fracture_energy, bond.weibull_modulus};
        sum.add_values<double>(values);
        sum.add_values<std::uint32_t>(std::span(&bond.seed, 1));
    }
    return fmt::format("{:016x}", sum.value());
}

/// By bodies that have any.
template <int Dim>
Json erosion_limits(const Scene<Dim>& scene) {
    Json limits = Json::object();
    for (std::size_t body = 0; body < scene.solid.erosion.size(); ++body) {
        const solid::ErosionLimits& of_body = scene.solid.erosion[body];
        const auto add = [&](const char* name, double limit) {
            if (limit < solid::ErosionLimits::none) limits[scene.mesh.body_names[body]][name] = limit;
        };
        add("strain", of_body.strain);
        add("plastic_strain", of_body.plastic_strain);
        add("stress", of_body.stress);
    }
    return limits;
}

}  // namespace

template <int Dim>
std::string identity(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Json of_run = {{"dimension", Dim},
                   {"bodies", scene.mesh.body_names},
                   {"cells", scene.mesh.n_cells()},
                   {"checksum of the meshes", checksum(scene.mesh)},
                   {"step [s]", result.run.dt},
                   {"steps", result.run.steps}};
    if (!scene.solid.bonds.empty()) of_run["checksum of the bonds"] = checksum_of_bonds<Dim>(scene.solid);
    if (Json limits = erosion_limits(scene); !limits.empty()) of_run["limits of erosion"] = std::move(limits);
    of_run.update(to_json(scene.options));
    of_run.update(to_json(named_values(result.options)));
    for (const Option<RunOptions>& option : run_options())
        if (option.free_on_resume) of_run.erase(option.name);
    of_run.erase("scene");  // where its file is
    return text_of(of_run);
}

int recorded_interval(const std::string& saved) {
    const Json there = Json::parse(saved, nullptr, false);
    return there.is_object() ? there.value("interval", 0) : 0;
}

void require_same_run(const std::string& saved, const std::string& now, bool other_end) {
    Json there = Json::parse(saved, nullptr, false), here = Json::parse(now);
    if (!there.is_object()) throw BadInput("a checkpoint does not say what run it is of: it is damaged.");
    if (other_end)
        for (Json* run : {&there, &here}) run->erase("steps");
    const auto shown = [](const Json& run, const std::string& name) {
        return run.contains(name) ? text_of(run[name]) : std::string("nothing");
    };
    for (const Json* run : {&there, &here})
        for (const auto& [name, value] : run->items())
            if (const std::string was = shown(there, name), is = shown(here, name); was != is)
                throw BadInput(
                    fmt::format("the checkpoint is of a run with {} = {}, and this one has {}. Go on with the scene and "
                                "the options of the run that was stopped, or run from the start.",
                                name, was, is));
}

#define ABUT_INSTANTIATE(Dim) template std::string identity<Dim>(const Scene<Dim>&, const RunResult<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
