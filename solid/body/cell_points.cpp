#include "abut/solid/body/cell_points.hpp"
#include "abut/base/rotation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "abut/base/decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {
namespace {

constexpr int most_placings = 20;
constexpr double placed_well = 1e-13;     // of the second moments of the body
constexpr double cells_on_a_line = 1e-8;  // least second moment over the largest
constexpr double stays_inside = 0.25;     // of the depth of its cell behind each face

template <int Dim>
constexpr int n_pairs = Dim*(Dim + 1) / 2;

/// Components of a symmetric matrix, then those of a vector.
template <int Dim>
SmallMatrix<n_pairs<Dim> + Dim, 1> unknowns_of(const Matrix<Dim>& m, const Vector<Dim>& v) {
    SmallMatrix<n_pairs<Dim> + Dim, 1> all;
    int k = 0;
    for (int i = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j) all[k++] = m(i, j);
    for (int i = 0; i < Dim; ++i) all[k++] = v[i];
    return all;
}
/// 1 at a component of a symmetric matrix.
template <int Dim>
Matrix<Dim> unit(int component) {
    Matrix<Dim> m = Matrix<Dim>::Zero();
    for (int i = 0, k = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j, ++k)
            if (k == component) m(i, j) = m(j, i) = 1.0;
    return m;
}

/// From the corner with the lowest number on, to that of its neighbours with the lower one: in the part of a rank a face may
/// be seen from its other side.
std::vector<std::int32_t> in_one_order(std::span<const std::int32_t> corners) {
    std::vector<std::int32_t> ordered(corners.begin(), corners.end());
    std::ranges::rotate(ordered, std::ranges::min_element(ordered));
    if (ordered.size() > 2 && ordered.back() < ordered[1]) std::reverse(ordered.begin() + 1, ordered.end());
    return ordered;
}

template <int Dim>
bool is_inside(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Vector<Dim>& point) {
    for (const std::int32_t f : mesh.cell_faces[cell]) {
        const Vector<Dim> out = mesh.face_cells[f][0] == cell ? mesh.face_normal[f] : Vector<Dim>(-mesh.face_normal[f]);
        const double depth = (mesh.face_centroid[f] - mesh.cell_centroid[cell]).dot(out);
        if (!((mesh.face_centroid[f] - point).dot(out) >= stays_inside * depth)) return false;
    }
    return true;
}

/// The rotation that fits sum m x' X'^T best; of points on a line, about which it is not known, the least one.
template <int Dim>
Matrix<Dim> least_rotation(const Matrix<Dim>& moment) {
    if constexpr (Dim == 3) {
        const SingularValues svd = singular_values(moment);
        if (svd.values[1] <= 1e-10 * svd.values[0]) return rotation_between(svd.v.col(0), svd.u.col(0));
    }
    return nearest_rotation(moment);
}

}  // namespace

/// Sum over simplices from the centroid to the faces, cut into simplices.
template <int Dim>
Matrix<Dim> own_second_moment(const mesh::Mesh<Dim>& mesh, std::int32_t cell) {
    Matrix<Dim> moment = Matrix<Dim>::Zero();
    for (const std::int32_t f : mesh.cell_faces[cell]) {
        const auto corners = in_one_order(mesh.face_vertices[f]);
        for (std::size_t i = 1; i + Dim - 2 < corners.size(); ++i) {
            Matrix<Dim> arms;
            arms.col(0) = mesh.vertices[corners[0]] - mesh.cell_centroid[cell];
            for (int k = 1; k < Dim; ++k)
                arms.col(k) = mesh.vertices[corners[i + static_cast<std::size_t>(k) - 1]] - mesh.cell_centroid[cell];
            const Vector<Dim> sum = arms * Vector<Dim>::Ones();
            constexpr double factorial = Dim == 2 ? 24.0 : 120.0;  // (Dim + 2)!
            moment += std::abs(arms.determinant()) / factorial * (arms * arms.transpose() + sum * sum.transpose());
        }
    }
    return moment;
}

template <int Dim>
Vector<Dim> CellPoints<Dim>::place(const mesh::Mesh<Dim>& mesh, std::int32_t cell) const {
    const Vector<Dim> arm = (mesh.cell_centroid[cell] - centre) / size;
    const Matrix<Dim> own = own_second_moment(mesh, cell) / (mesh.cell_measure[cell] * size * size);
    return mesh.cell_centroid[cell] + size * (own * (slope * arm + shift));
}

template <int Dim>
std::optional<CellPoints<Dim>> find_cell_points(const mesh::Mesh<Dim>& mesh, std::int32_t body,
                                                std::pair<std::int32_t, std::int32_t> cells, double density,
                                                const RankPart<Dim>& part) {
    constexpr int n = n_pairs<Dim> + Dim;
    using Unknowns = SmallMatrix<n, 1>;
    using Sums = SmallMatrix<n, n + 2>;
    const auto sum = [&](const auto& zero, const auto& term) {
        return part.sum_of_body(static_cast<std::size_t>(body), zero, term);
    };
    const Vector<Dim> zero = Vector<Dim>::Zero();

    const double measure = sum(0.0, [&](std::int32_t c) { return mesh.cell_measure[c]; });
    CellPoints<Dim> points;
    points.centre =
        sum(zero, [&](std::int32_t c) -> Vector<Dim> { return mesh.cell_measure[c] * mesh.cell_centroid[c]; }) / measure;
    points.centre +=  // once more, with arms
        sum(zero,
            [&](std::int32_t c) -> Vector<Dim> { return mesh.cell_measure[c] * (mesh.cell_centroid[c] - points.centre); }) /
        measure;
    const Matrix<Dim> moment = sum(Matrix<Dim>::Zero(), [&](std::int32_t c) -> Matrix<Dim> {
        const Vector<Dim> arm = mesh.cell_centroid[c] - points.centre;
        return mesh.cell_measure[c] * arm * arm.transpose();
    });
    const Vector<Dim> moments = symmetric_eigenvalues(moment);
    if (!(moments[0] > cells_on_a_line * moments[Dim - 1])) return std::nullopt;
    points.size = std::sqrt(moment.trace() / measure);
    points.slope.setZero();
    points.shift.setZero();

    // Newton's method in S and b. Columns: the values of both sides, then the derivatives of the left ones.
    bool found = false;
    for (int iteration = 0; iteration < most_placings; ++iteration) {
        const Sums sums = sum(Sums::Zero(), [&](std::int32_t c) -> Sums {
            const Vector<Dim> x = (mesh.cell_centroid[c] - points.centre) / points.size;
            const Matrix<Dim> own = own_second_moment(mesh, c) / (mesh.cell_measure[c] * points.size * points.size);
            const Vector<Dim> y = x + own * (points.slope * x + points.shift);
            Sums of_cell;
            of_cell.col(0) = unknowns_of<Dim>(y * y.transpose(), y);
            of_cell.col(1) = unknowns_of<Dim>(x * x.transpose() + own, zero);
            for (int k = 0; k < n; ++k) {
                const Vector<Dim> change =
                    k < n_pairs<Dim> ? Vector<Dim>(own * (unit<Dim>(k) * x)) : Vector<Dim>(own.col(k - n_pairs<Dim>));
                const Matrix<Dim> half = change * y.transpose();
                of_cell.col(2 + k) = unknowns_of<Dim>(half + half.transpose(), change);
            }
            return mesh.cell_measure[c] / measure * of_cell;
        });
        const Unknowns missing = sums.col(1) - sums.col(0);
        found = missing.norm() <= placed_well;
        if (found) break;
        const Unknowns step = as_eigen(sums.template rightCols<n>()).fullPivLu().solve(as_eigen(missing));
        if (!step.allFinite()) return std::nullopt;
        for (int k = 0; k < n_pairs<Dim>; ++k) points.slope += step[k] * unit<Dim>(k);
        points.shift += step.template tail<Dim>();
    }
    bool stays = found;
    for (std::int32_t c = cells.first; stays && c < cells.second; ++c)
        stays = is_inside<Dim>(mesh, c, points.place(mesh, c));
    if (part.any(!stays)) return std::nullopt;
    points.inverse_x = (density * moment).inverse();
    points.inverse_y = sum(Matrix<Dim>::Zero(), [&](std::int32_t c) -> Matrix<Dim> {
        const Vector<Dim> arm = points.place(mesh, c) - points.centre;
        return density * mesh.cell_measure[c] * arm * arm.transpose();
    });
    points.inverse_y = points.inverse_y.inverse();
    return points;
}

// Values of cells, at their centroids or at their points --------------------------------------------------------------

/// Sum of m v (x - centre)^T over the cells of a body, `x_of` being where the values v are.
template <int Dim>
template <class PositionOf>
Matrix<Dim> Bodies<Dim>::mean_slope(std::size_t body, std::span<const Vector<Dim>> of_mesh_cells, std::int32_t on,
                                    const PositionOf& x_of) const {
    return rank_part_->sum_of_body(body, Matrix<Dim>::Zero(), [&](std::int32_t c) -> Matrix<Dim> {
        return masses_[c] * of_mesh_cells[c + on] * (x_of(c) - cell_points_[body]->centre).transpose();
    });
}

/// Takes values at the points of the cells to their centroids, in the order of the whole mesh.
template <int Dim>
void Bodies<Dim>::to_centroids(std::vector<Vector<Dim>>& of_mesh_cells) const {
    for (std::size_t i = 0; i < cell_points_.size(); ++i) {
        if (!cell_points_[i]) continue;
        const CellPoints<Dim>& points = *cell_points_[i];
        const auto cells = cells_of_body(deformable(), static_cast<std::int32_t>(i));
        const std::int32_t on = cells_of_body(mesh_, deformable_bodies_[i]).first - cells.first;
        const Matrix<Dim> slope =
            mean_slope(i, of_mesh_cells, on, [&](std::int32_t c) { return rest_[c]; }) * points.inverse_y;
        for (std::int32_t c = cells.first; c < cells.second; ++c)
            of_mesh_cells[c + on] += slope * (mesh_.cell_centroid[c + on] - rest_[c]);
    }
}

/// The other way round.
template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::to_points(std::span<const Vector<Dim>> of_mesh_cells) const {
    std::vector<Vector<Dim>> at_points(of_mesh_cells.begin(), of_mesh_cells.end());
    for (std::size_t i = 0; i < cell_points_.size(); ++i) {
        if (!cell_points_[i]) continue;
        const CellPoints<Dim>& points = *cell_points_[i];
        const auto cells = cells_of_body(deformable(), static_cast<std::int32_t>(i));
        const std::int32_t on = cells_of_body(mesh_, deformable_bodies_[i]).first - cells.first;
        const Matrix<Dim> slope =
            mean_slope(i, of_mesh_cells, on, [&](std::int32_t c) { return mesh_.cell_centroid[c + on]; }) * points.inverse_x;
        for (std::int32_t c = cells.first; c < cells.second; ++c)
            at_points[c + on] += slope * (rest_[c] - mesh_.cell_centroid[c + on]);
    }
    return at_points;
}

template <int Dim>
double Bodies<Dim>::cell_mass(std::int32_t cell) const {
    return options_.materials[static_cast<std::size_t>(mesh_.cell_body[cell])].density * mesh_.cell_measure[cell];
}

/// Values of the cells of the whole mesh; those of rigid bodies are left open.
template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::of_deformable_cells(std::span<const Vector<Dim>> of_points) const {
    std::vector<Vector<Dim>> result(static_cast<std::size_t>(mesh_.n_cells()));
    auto next = of_points.begin();
    for (const std::int32_t body : deformable_bodies_) {
        const auto [begin, end] = cells_of_body(mesh_, body);
        std::copy_n(next, end - begin, result.begin() + begin);
        next += end - begin;
    }
    return result;
}

template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::of_cells(std::span<const Vector<Dim>> q) const {
    std::vector<Vector<Dim>> result = of_deformable_cells(q);
    to_centroids(result);
    for (std::size_t i = 0; i < rigid_->size(); ++i) {
        const RigidPlace<Dim> place = rigid_->place(i, q);
        const auto [begin, end] = cells_of_body(mesh_, rigid_->mesh_body(i));
        for (std::int32_t c = begin; c < end; ++c)
            result[c] = place(mesh_.cell_centroid[c] - rigid_->rest_centre(i)) - mesh_.cell_centroid[c];
    }
    return result;
}

template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::of_points(std::span<const Vector<Dim>> displacement) const {
    const std::vector<Vector<Dim>> at_points = to_points(displacement);
    std::vector<Vector<Dim>> q;
    for (const std::int32_t body : deformable_bodies_) {
        const auto [begin, end] = cells_of_body(mesh_, body);
        q.insert(q.end(), at_points.begin() + begin, at_points.begin() + end);
    }
    q.resize(rest_.size());
    for (std::size_t i = 0; i < rigid_->size(); ++i) {
        const auto [begin, end] = cells_of_body(mesh_, rigid_->mesh_body(i));
        Vector<Dim> shift = Vector<Dim>::Zero();
        Matrix<Dim> moment = Matrix<Dim>::Zero();
        double largest = 0.0;
        for (std::int32_t c = begin; c < end; ++c) {
            const Vector<Dim> arm = mesh_.cell_centroid[c] - rigid_->rest_centre(i);
            shift += cell_mass(c) / rigid_->mass(i) * displacement[c];
            moment += cell_mass(c) * (arm + displacement[c]) * arm.transpose();
            largest = std::max(largest, (displacement[c] - displacement[begin]).norm());
        }
        const Matrix<Dim> turn = largest == 0.0 ? Matrix<Dim>::Identity() : least_rotation<Dim>(moment);
        rigid_->set_displacement(i, {rigid_->rest_centre(i) + shift, turn}, q);
    }
    return q;
}

template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::momenta(std::span<const Vector<Dim>> velocity) const {
    const std::vector<Vector<Dim>> at_points = to_points(velocity);
    std::vector<Vector<Dim>> p;
    for (const std::int32_t body : deformable_bodies_) {
        const auto [begin, end] = cells_of_body(mesh_, body);
        for (std::int32_t c = begin; c < end; ++c) p.push_back(cell_mass(c) * at_points[c]);
    }
    p.resize(rest_.size());
    for (std::size_t i = 0; i < rigid_->size(); ++i) {
        const auto [begin, end] = cells_of_body(mesh_, rigid_->mesh_body(i));
        Vector<Dim> mean = Vector<Dim>::Zero();
        AxialVector<Dim> angular = AxialVector<Dim>::Zero();
        Matrix<Dim> second_moment = Matrix<Dim>::Zero();
        for (std::int32_t c = begin; c < end; ++c) {
            const Vector<Dim> arm = mesh_.cell_centroid[c] - rigid_->rest_centre(i);
            mean += cell_mass(c) / rigid_->mass(i) * velocity[c];
            angular += cell_mass(c) * moment<Dim>(arm, Vector<Dim>(velocity[c] - velocity[begin]));
            second_moment += cell_mass(c) * arm * arm.transpose();
        }
        rigid_->set_momentum(i, mean, spin_of<Dim>(second_moment, angular), p);
    }
    return p;
}

template <int Dim>
std::vector<Vector<Dim>> Bodies<Dim>::velocities(std::span<const Vector<Dim>> p) const {
    std::vector<Vector<Dim>> of_points(p.begin(), p.end());
    for (std::size_t i = 0; i < of_points.size(); ++i) of_points[i] /= masses_[i];
    std::vector<Vector<Dim>> result = of_deformable_cells(of_points);
    to_centroids(result);
    for (std::size_t i = 0; i < rigid_->size(); ++i) {
        const RigidPlace<Dim> velocity = rigid_->velocity(i, of_points);
        const auto [begin, end] = cells_of_body(mesh_, rigid_->mesh_body(i));
        for (std::int32_t c = begin; c < end; ++c) result[c] = velocity(mesh_.cell_centroid[c] - rigid_->rest_centre(i));
    }
    return result;
}

#define ABUT_INSTANTIATE(Dim)                                                                                       \
    template Matrix<Dim> own_second_moment(const mesh::Mesh<Dim>&, std::int32_t);                                   \
    template Vector<Dim> CellPoints<Dim>::place(const mesh::Mesh<Dim>&, std::int32_t) const;                        \
    template std::optional<CellPoints<Dim>> find_cell_points(                                                       \
        const mesh::Mesh<Dim>&, std::int32_t, std::pair<std::int32_t, std::int32_t>, double, const RankPart<Dim>&); \
    template void Bodies<Dim>::to_centroids(std::vector<Vector<Dim>>&) const;                                       \
    template std::vector<Vector<Dim>> Bodies<Dim>::to_points(std::span<const Vector<Dim>>) const;                   \
    template double Bodies<Dim>::cell_mass(std::int32_t) const;                                                     \
    template std::vector<Vector<Dim>> Bodies<Dim>::of_deformable_cells(std::span<const Vector<Dim>>) const;         \
    template std::vector<Vector<Dim>> Bodies<Dim>::of_cells(std::span<const Vector<Dim>>) const;                    \
    template std::vector<Vector<Dim>> Bodies<Dim>::of_points(std::span<const Vector<Dim>>) const;                   \
    template std::vector<Vector<Dim>> Bodies<Dim>::momenta(std::span<const Vector<Dim>>) const;                     \
    template std::vector<Vector<Dim>> Bodies<Dim>::velocities(std::span<const Vector<Dim>>) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
