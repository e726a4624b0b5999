#include "apps/support/scene_of_rank.hpp"

#include <utility>

#include "abut/mesh/outline.hpp"
#include "apps/support/rank_session.hpp"

namespace abut::apps {
namespace {

template <int Dim>
run::Scene<Dim> scene_with_mesh(const MakeScene<Dim>& make_scene) {
    Answers mesh;
    run::Scene<Dim> scene;
    on_all([&] { scene = make_scene(mesh); });
    static_cast<void>(of_first_rank(std::move(mesh).kept()));
    on_all([] {});  // the others make theirs
    return scene;
}

template <int Dim>
run::Scene<Dim> scene_with_outline(const MakeScene<Dim>& make_scene) {
    on_all([] {});  // rank 0 makes its own
    Answers mesh(of_first_rank({}));
    run::Scene<Dim> scene;
    on_all([&] {
        scene = make_scene(mesh);
        scene.mesh = mesh::outline_of(scene.mesh);
    });
    return scene;
}

}  // namespace

template <int Dim>
run::Scene<Dim> scene_of_rank(const MakeScene<Dim>& make_scene) {
    const bool is_first = !rank_session() || rank_session()->all().rank() == 0;
    return is_first ? scene_with_mesh(make_scene) : scene_with_outline(make_scene);
}

template run::Scene<2> scene_of_rank(const MakeScene<2>&);
template run::Scene<3> scene_of_rank(const MakeScene<3>&);

}  // namespace abut::apps
