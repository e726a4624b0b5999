#include "abut/run/files/run_identity.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <span>

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

}  // namespace

template <int Dim>
std::string identity(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Json of_run = {{"dimension", Dim},
                   {"bodies", scene.mesh.body_names},
                   {"cells", scene.mesh.n_cells()},
                   {"checksum of the meshes", checksum(scene.mesh)},
                   {"step [s]", result.dt},
                   {"steps", result.steps}};
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
