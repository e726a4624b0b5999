#include "abut/run/body_names.hpp"

#include <fmt/format.h>

namespace abut::run {

template <int Dim>
std::string name_of_obstacle(const Scene<Dim>& scene, std::size_t obstacle) {
    return obstacle < scene.outputs.obstacles.size() ? scene.outputs.obstacles[obstacle]
                                                     : fmt::format("obstacle_{}", obstacle);
}

template <int Dim>
std::string quoted_name(const Scene<Dim>& scene, std::int32_t body) {
    const auto i = static_cast<std::size_t>(body), n = scene.mesh.body_names.size();
    return i < n ? fmt::format("'{}'", scene.mesh.body_names[i])
                 : fmt::format("obstacle '{}'", name_of_obstacle(scene, i - n));
}

template <int Dim>
std::string quoted_side(const Scene<Dim>& scene, std::int32_t side) {
    const std::size_t i = static_cast<std::size_t>(side), n = scene.mesh.body_names.size() + scene.solid.obstacles.size();
    return i < n ? quoted_name(scene, side) : fmt::format("'{}'", scene.mesh.groups[i - n].name);
}

#define ABUT_INSTANTIATE(Dim)                                                                  \
    template std::string name_of_obstacle<Dim>(const Scene<Dim>& scene, std::size_t obstacle); \
    template std::string quoted_name<Dim>(const Scene<Dim>& scene, std::int32_t body);         \
    template std::string quoted_side<Dim>(const Scene<Dim>& scene, std::int32_t side);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
