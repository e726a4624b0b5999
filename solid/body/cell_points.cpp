#include "abut/solid/body/cell_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "abut/base/decompositions.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {
namespace {

constexpr int most_placings = 20;
constexpr double placed_well = 1e-13;         // of the second moments of the body
constexpr double cells_on_a_line = 1e-8;  // least second moment over the largest
constexpr double stays_inside = 0.25;     // of the depth of its cell behind each face

template <int Dim>
constexpr int n_pairs = Dim*(Dim + 1) / 2;

/// Components of a symmetric matrix.
template <int Dim>
Eigen::Matrix<double, n_pairs<Dim>, 1> packed(const Matrix<Dim>& m) {
    Eigen::Matrix<double, n_pairs<Dim>, 1> all;
    for (int i = 0, k = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j) all[k++] = m(i, j);
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
            const Vector<Dim> sum = arms.rowwise().sum();
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
    using Unknowns = Eigen::Matrix<double, n, 1, Eigen::DontAlign>;
    using Sums = Eigen::Matrix<double, n, n + 2, Eigen::DontAlign>;
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
    const Matrix<Dim> moment = sum(Matrix<Dim>(Matrix<Dim>::Zero()), [&](std::int32_t c) -> Matrix<Dim> {
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
        const Sums sums = sum(Sums(Sums::Zero()), [&](std::int32_t c) -> Sums {
            const Vector<Dim> x = (mesh.cell_centroid[c] - points.centre) / points.size;
            const Matrix<Dim> own = own_second_moment(mesh, c) / (mesh.cell_measure[c] * points.size * points.size);
            const Vector<Dim> y = x + own * (points.slope * x + points.shift);
            Sums of_cell;
            of_cell.col(0) << packed<Dim>(y * y.transpose()), y;
            of_cell.col(1) << packed<Dim>(x * x.transpose() + own), zero;
            for (int k = 0; k < n; ++k) {
                const Vector<Dim> change =
                    k < n_pairs<Dim> ? Vector<Dim>(own * (unit<Dim>(k) * x)) : Vector<Dim>(own.col(k - n_pairs<Dim>));
                const Matrix<Dim> half = change * y.transpose();
                of_cell.col(2 + k) << packed<Dim>(half + half.transpose()), change;
            }
            return mesh.cell_measure[c] / measure * of_cell;
        });
        const Unknowns missing = sums.col(1) - sums.col(0);
        found = missing.norm() <= placed_well;
        if (found) break;
        const Eigen::Matrix<double, n, n> slope = sums.template rightCols<n>();
        const Unknowns step = slope.fullPivLu().solve(missing);
        if (!step.allFinite()) return std::nullopt;
        for (int k = 0; k < n_pairs<Dim>; ++k) points.slope += step[k] * unit<Dim>(k);
        points.shift += step.template tail<Dim>();
    }
    bool stays = found;
    for (std::int32_t c = cells.first; stays && c < cells.second; ++c)
        stays = is_inside<Dim>(mesh, c, points.place(mesh, c));
    if (part.any(!stays)) return std::nullopt;
    points.inverse_x = (density * moment).inverse();
    points.inverse_y = sum(Matrix<Dim>(Matrix<Dim>::Zero()), [&](std::int32_t c) -> Matrix<Dim> {
        const Vector<Dim> arm = points.place(mesh, c) - points.centre;
        return density * mesh.cell_measure[c] * arm * arm.transpose();
    });
    points.inverse_y = points.inverse_y.inverse().eval();
    return points;
}

#define ABUT_INSTANTIATE(Dim)                                                                \
    template Matrix<Dim> own_second_moment(const mesh::Mesh<Dim>&, std::int32_t);            \
    template Vector<Dim> CellPoints<Dim>::place(const mesh::Mesh<Dim>&, std::int32_t) const; \
    template std::optional<CellPoints<Dim>> find_cell_points(                                \
        const mesh::Mesh<Dim>&, std::int32_t, std::pair<std::int32_t, std::int32_t>, double, const RankPart<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
