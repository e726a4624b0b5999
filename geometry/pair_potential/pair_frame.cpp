#include "abut/geometry/pair_potential/pair_frame.hpp"

namespace abut::geometry {
namespace {

template <int Dim>
PairCorners<Dim> from_mean(const PairCorners<Dim>& x) {
    Vector<Dim> mean = Vector<Dim>::Zero();
    for (const Vector<Dim>& corner : x) mean += corner;
    mean /= 2 * Dim;
    PairCorners<Dim> y;
    for (std::size_t v = 0; v < x.size(); ++v) y[v] = x[v] - mean;
    return y;
}

Vector<2> turned_left(const Vector<2>& a) { return {-a[1], a[0]}; }
Vector<2> turned_right(const Vector<2>& a) { return {a[1], -a[0]}; }

template <int Dim>
Vector<Dim> mean_of(const Vector<Dim>& a, const Vector<Dim>& b) {
    return 0.5 * (a + b);
}

/// Least squared length of a mean of two unit vectors: rounding errors of momenta are divided by it.
constexpr double turned_over = 1e-8;

}  // namespace

PairFrame<2>::PairFrame(const PairCorners<2>& x, const PairLaw<2>& law) : y(from_mean<2>(x)) {
    m = turned_right(x[1] - x[0]) / law.length[0] - turned_right(x[3] - x[2]) / law.length[1];
    m_length = m.norm();
    normal = m / m_length;
    along = turned_right(normal);
    for (std::size_t v = 0; v < y.size(); ++v) z[v] = {along.dot(y[v]), normal.dot(y[v])};
}

PairFrame<3>::PairFrame(const PairCorners<3>& x, const PairLaw<3>&)
    : y(from_mean<3>(x)), edge_b(x[1] - x[0]), edge_c(x[2] - x[0]) {
    e[0] = edge_b.normalized();
    e[2] = edge_b.cross(edge_c).normalized();
    e[1] = e[2].cross(e[0]);
    for (std::size_t v = 0; v < y.size(); ++v) z[v] = {e[0].dot(y[v]), e[1].dot(y[v]), e[2].dot(y[v])};
}

template <>
bool turns_over(const PairFrame<2>& start, const PairFrame<2>& end) {
    return mean_of<2>(start.normal, end.normal).squaredNorm() < turned_over;
}
template <>
bool turns_over(const PairFrame<3>& start, const PairFrame<3>& end) {
    return mean_of<3>(start.e[0], end.e[0]).squaredNorm() < turned_over ||
           mean_of<3>(start.e[2], end.e[2]).squaredNorm() < turned_over;
}

template <>
PairCorners<2> in_mean_frame(const PairFrame<2>& start, const PairFrame<2>& end, const PairLaw<2>& law,
                             const PairCorners<2>& phi) {
    const Vector<2> along = mean_of<2>(start.along, end.along), normal = mean_of<2>(start.normal, end.normal);
    PairCorners<2> result;
    double moment = 0.0;
    for (std::size_t v = 0; v < phi.size(); ++v) {
        result[v] = phi[v][0] * along + phi[v][1] * normal;
        const Vector<2> y = mean_of<2>(start.y[v], end.y[v]);
        moment += phi[v][0] * normal.dot(y) - phi[v][1] * along.dot(y);
    }
    result = from_mean<2>(result);
    const double m_length = 0.5 * (start.m_length + end.m_length);
    const Vector<2> pull = turned_left(-moment / (m_length * normal.squaredNorm()) * along);
    result[0] -= pull / law.length[0];
    result[1] += pull / law.length[0];
    result[2] += pull / law.length[1];
    result[3] -= pull / law.length[1];
    return result;
}

template <>
PairCorners<3> in_mean_frame(const PairFrame<3>& start, const PairFrame<3>& end, const PairLaw<3>&,
                             const PairCorners<3>& phi) {
    std::array<Vector<3>, 3> e;
    for (std::size_t a = 0; a < e.size(); ++a) e[a] = mean_of<3>(start.e[a], end.e[a]);
    PairCorners<3> result;
    Vector<3> moment = Vector<3>::Zero();
    for (std::size_t v = 0; v < phi.size(); ++v) {
        result[v] = phi[v][0] * e[0] + phi[v][1] * e[1] + phi[v][2] * e[2];
        moment += result[v].cross(mean_of<3>(start.y[v], end.y[v]));
    }
    result = from_mean<3>(result);
    const Vector<3> edge_b = mean_of<3>(start.edge_b, end.edge_b), edge_c = mean_of<3>(start.edge_c, end.edge_c);
    const auto turning = Matrix<3>::from_columns(e[1].cross(edge_b), e[2].cross(edge_b), e[2].cross(edge_c));  // L^T
    const Vector<3> lambda = -(turning.inverse() * moment);
    const Vector<3> at_b = lambda[0] * e[1] + lambda[1] * e[2], at_c = lambda[2] * e[2];
    result[0] -= at_b + at_c;
    result[1] += at_b;
    result[2] += at_c;
    return result;
}

}  // namespace abut::geometry
