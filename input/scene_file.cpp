#include "abut/input/scene_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "abut/input/make_scene.hpp"
#include "abut/input/read_settings.hpp"

namespace abut::input {
namespace {

std::shared_ptr<const Settings> sound_settings(ReadSettings read) {
    if (!read.faults.empty()) throw SceneError(std::move(read.faults));
    return std::make_shared<const Settings>(std::move(read.settings));
}

}  // namespace

SceneFile::SceneFile(const std::filesystem::path& path, const Overrides& overrides)
    : settings_(sound_settings(read_settings(path, overrides))) {}
SceneFile::SceneFile(const SceneText& scene, const Overrides& overrides)
    : settings_(sound_settings(read_settings(scene, overrides))) {}

int SceneFile::dimension() const { return settings_->dim; }
const run::RunOptions& SceneFile::options() const { return settings_->options; }
std::string SceneFile::name() const { return settings_->file.stem().string(); }

template <int Dim>
run::Scene<Dim> SceneFile::scene() const {
    Answers mesh;
    return scene<Dim>(mesh);
}

template <int Dim>
run::Scene<Dim> SceneFile::scene(Answers& mesh) const {
    if (Dim != settings_->dim)
        throw Misuse(fmt::format("{}: a scene of dimension {} was asked for, it has {}. Ask for that.",
                                 settings_->file.string(), Dim, settings_->dim));
    std::vector<Fault> faults;
    run::Scene<Dim> scene = make_scene<Dim>(*settings_, mesh, faults);
    if (!faults.empty()) throw SceneError(std::move(faults));
    return scene;
}

template run::Scene<2> SceneFile::scene<2>() const;
template run::Scene<3> SceneFile::scene<3>() const;
template run::Scene<2> SceneFile::scene<2>(Answers&) const;
template run::Scene<3> SceneFile::scene<3>(Answers&) const;

}  // namespace abut::input
