#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "abut/base/answers.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/given_meshes.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

struct Settings;

/// Values that replace those of a file.
struct Overrides {
    std::vector<std::string> set{};                   ///< "bodies.left.density=2": key and value
    std::function<void(run::RunOptions&)> options{};  ///< changes those of the file; may be empty
    /// Path at which the file is taken to be, if it is a copy: paths in it begin there, and the scene has its name.
    std::filesystem::path origin{};
    std::shared_ptr<const GivenMeshes> meshes{};  ///< that bodies may have; null: none
};

/// A scene that is in no file.
struct SceneText {
    std::string toml;
    std::filesystem::path file =
        "scene";  ///< where it is taken to be: paths in it begin in that folder, and it has that name
};

/// A scene in TOML, of a file or a text, docs/scenes.md.
///
///     const input::SceneFile file("scenes/slipping_cylinders.toml");
///     const run::Scene<2> scene = file.scene<2>();
///     run::RunResult<2> result = run::simulate<2>(scene, file.options());
class SceneFile {
public:
    /// Throws SceneError with all faults of keys and values: what is unknown or missing, of a wrong type or out of range,
    /// what does not go together.
    explicit SceneFile(const std::filesystem::path& path, const Overrides& overrides = {});
    explicit SceneFile(const SceneText& scene, const Overrides& overrides = {});

    [[nodiscard]] int dimension() const;  ///< 2 or 3
    [[nodiscard]] const run::RunOptions& options() const;
    [[nodiscard]] std::string name() const;  ///< "slipping_cylinders"
    /// Makes the meshes and all that acts on them. Throws SceneError for meshes that cannot be made or read, for groups
    /// that no mesh has, and for bodies that overlap; Misuse if `Dim` is not the dimension.
    template <int Dim>
    [[nodiscard]] run::Scene<Dim> scene() const;
    /// For several processes that have the same file: the first one makes the scene and keeps answers about its mesh. The
    /// others are given these, make no mesh, and have the outline of it in their scene (mesh::outline_of).
    template <int Dim>
    [[nodiscard]] run::Scene<Dim> scene(Answers& mesh) const;

private:
    std::shared_ptr<const Settings> settings_;
};

}  // namespace abut::input
