#pragma once
#include <functional>

#include "abut/base/answers.hpp"
#include "abut/run/scene.hpp"

namespace abut::apps {

/// Makes a scene. On ranks other than 0 it is given the answers about the mesh that rank 0 has kept, and cells that it
/// gives the mesh all the same are dropped.
template <int Dim>
using MakeScene = std::function<run::Scene<Dim>(Answers& mesh)>;

/// The scene: on rank 0, or where the program runs alone, with its mesh; on other ranks with the outline of that mesh. A
/// call of all ranks; throws on all what one throws.
template <int Dim>
[[nodiscard]] run::Scene<Dim> scene_of_rank(const MakeScene<Dim>& make_scene);

}  // namespace abut::apps
