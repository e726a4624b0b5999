#include "abut/solid/body_inertia.hpp"

#include "abut/base/decompositions.hpp"
#include "abut/solid/all_points.hpp"
#include "abut/solid/body/cell_points.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

/// Sum m (x - centre)(x - centre)^T for density 1 or masses.
template <int Dim>
struct InertiaSums {
    double mass = 0.0;
    Vector<Dim> first = Vector<Dim>::Zero();
    Matrix<Dim> second = Matrix<Dim>::Zero();

    void add(double m, const Vector<Dim>& arm) {
        mass += m;
        first += m * arm;
        second += m * arm * arm.transpose();
    }
    [[nodiscard]] Matrix<Dim> about_centre() const { return second - first * first.transpose() / mass; }
};

}  // namespace

template <int Dim>
std::vector<BodyInertia<Dim>> inertia_of_bodies(const Solid<Dim>& solid, const mesh::Mesh<Dim>& mesh) {
    const AllPoints<Dim> points(solid);
    if (solid.ranks().rank() > 0) return {};
    const auto n = static_cast<std::size_t>(mesh.n_bodies());
    std::vector<Vector<Dim>> origin(n, Vector<Dim>::Zero());
    std::vector<InertiaSums<Dim>> exact(n), of_points(n);
    for (std::int32_t c = mesh.n_cells() - 1; c >= 0; --c) origin[mesh.cell_body[c]] = mesh.cell_centroid[c];
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const std::int32_t body = mesh.cell_body[c];
        const double density = solid.options().materials[static_cast<std::size_t>(body)].density;
        exact[body].add(density * mesh.cell_measure[c], mesh.cell_centroid[c] - origin[body]);
        exact[body].second += density * own_second_moment(mesh, c);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::int32_t body = points.body()[i];
        of_points[body].add(points.mass()[i], points.rest()[i] - origin[body]);
    }
    std::vector<BodyInertia<Dim>> bodies(n);
    for (std::size_t body = 0; body < n; ++body) {
        const Matrix<Dim> whole = exact[body].about_centre(), seen = of_points[body].about_centre();
        if constexpr (Dim == 2) {
            bodies[body].exact[0] = whole.trace();
            bodies[body].share[0] = seen.trace() / whole.trace();
        } else {
            const SymmetricEigen<3> axes =
                symmetric_eigen(whole);  // increasing: the moment about an axis is the rest of the trace
            for (int k = 0; k < 3; ++k) {
                const Vector<3> axis = axes.vectors.col(2 - k);
                bodies[body].exact[k] = whole.trace() - axis.dot(whole * axis);
                bodies[body].share[k] = (seen.trace() - axis.dot(seen * axis)) / bodies[body].exact[k];
            }
        }
    }
    return bodies;
}

template std::vector<BodyInertia<2>> inertia_of_bodies(const Solid<2>&, const mesh::Mesh<2>&);
template std::vector<BodyInertia<3>> inertia_of_bodies(const Solid<3>&, const mesh::Mesh<3>&);

}  // namespace abut::solid
