#include "abut/run/watch/rest_energy.hpp"

#include <algorithm>
#include <limits>

namespace abut::run {

template <int Dim>
double rest_energy(const mesh::Mesh<Dim>& mesh, const std::vector<solid::Material>& materials, double dt,
                   std::int64_t steps) {
    double farthest = 0.0, mass = 0.0;
    for (const Vector<Dim>& vertex : mesh.vertices) farthest = std::max(farthest, vertex.cwiseAbs().maxCoeff());
    for (std::size_t c = 0; c < mesh.cell_measure.size(); ++c)
        mass += materials[static_cast<std::size_t>(mesh.cell_body[c])].density * mesh.cell_measure[c];
    const double speed = std::numeric_limits<double>::epsilon() * farthest / dt;
    return static_cast<double>(steps) * 0.5 * mass * speed * speed;
}

template double rest_energy<2>(const mesh::Mesh<2>&, const std::vector<solid::Material>&, double, std::int64_t);
template double rest_energy<3>(const mesh::Mesh<3>&, const std::vector<solid::Material>&, double, std::int64_t);

}  // namespace abut::run
