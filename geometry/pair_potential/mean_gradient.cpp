#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "abut/geometry/pair_potential/kernel.hpp"
#include "abut/geometry/pair_potential/pair_frame.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

template <int Dim>
double dot(const PairCorners<Dim>& a, const PairCorners<Dim>& b) {
    double sum = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
}

template <int Dim>
double largest_norm(const PairCorners<Dim>& a) {
    double largest = 0.0;
    for (const Vector<Dim>& corner : a) largest = std::max(largest, corner.squaredNorm());
    return std::sqrt(largest);
}

/// The straight path of a pair in its own coordinates.
template <int Dim>
struct PairPath {
    PairPath(const PairFrame<Dim>& start, const PairFrame<Dim>& end) : z_0(start.z) {
        for (std::size_t v = 0; v < z_0.size(); ++v) motion[v] = end.z[v] - start.z[v];
        size = std::max(largest_norm<Dim>(start.z), largest_norm<Dim>(end.z));
        distance = largest_norm<Dim>(motion);
    }
    [[nodiscard]] PairCorners<Dim> at(double s) const {
        PairCorners<Dim> z;
        for (std::size_t v = 0; v < z.size(); ++v) z[v] = z_0[v] + s * motion[v];
        return z;
    }
    /// True if no face turns or changes its shape, beyond what rounding does to corners.
    [[nodiscard]] bool only_translates() const {
        double change = 0.0;
        for (const int first : {0, Dim})
            for (int v = first + 1; v < first + Dim; ++v)
                change = std::max(change, (motion[v] - motion[first]).cwiseAbs().maxCoeff());
        return change <= 8.0 * eps * size;
    }

    PairCorners<Dim> z_0;
    PairCorners<Dim> motion;  ///< Delta z
    double size;              ///< largest |z|
    double distance;          ///< largest |Delta z|
};

constexpr std::size_t most_cuts = 8;  // of the event functions in 2D

/// Ends of the pieces of a step, ascending from 0 to 1.
struct Cuts {
    std::array<double, most_cuts + 2> at{0.0, 1.0};
    int pieces = 1;

    /// 0 <= s <= 1; anything else cuts nothing.
    void insert(double s) {
        if (!(s >= 0.0 && s <= 1.0)) return;
        if (pieces == static_cast<int>(most_cuts) + 1) throw std::logic_error("pair potential: more cuts than events");
        int i = ++pieces;
        for (; at[i - 1] > s; --i) at[i] = at[i - 1];
        at[i] = s;
    }
};

/// Cuts where the straight line from a to b crosses 0.
void cut_at_root(double a, double b, Cuts& cuts) {
    if ((a < 0.0) != (b < 0.0)) cuts.insert(a / (a - b));
}

/// Distance of the corners of each face from the line of the other, times its length, and of ends along the pair.
std::array<double, most_cuts> event_functions(const PairCorners<2>& z) {
    const auto beside = [&](int corner, int face) {
        const Vector<2>&start = z[2 * face], edge = z[2 * face + 1] - start, from = z[corner] - start;
        return edge[0] * from[1] - edge[1] * from[0];
    };
    return {z[0][0] - z[3][0], z[1][0] - z[2][0], z[0][0] - z[2][0], z[1][0] - z[3][0],
            beside(0, 1),      beside(1, 1),      beside(2, 0),      beside(3, 0)};
}

/// Roots of straight lines between the ends: they need not be exact, since the correction takes up what is left.
Cuts cuts_of(const PairPath<2>& path, const PairLaw<2>&, const PairMeanGradient<2>&) {
    Cuts cuts;
    const auto at_0 = event_functions(path.z_0), at_1 = event_functions(path.at(1.0));
    for (std::size_t i = 0; i < at_0.size(); ++i) cut_at_root(at_0[i], at_1[i], cuts);
    return cuts;
}

/// Cuts where the contact begins or ends, by the least gap over the overlap.
void cut_at_touch(const PairPath<3>& path, const PairLaw<3>& law, const PairMeanGradient<3>& ends, Cuts& cuts) {
    const bool begins = ends.energy_0 == 0.0;
    const PairCorners<3> apart = begins ? path.z_0 : path.at(1.0);
    if (facing_cosine<3>(apart) >= law.facing.none) return;
    const PairView view = pair_view<3>(PairNormals<3>(apart), apart, law.offset);
    if (view.overlap == 0.0) return;
    cut_at_root(begins ? view.gap : ends.gap_0, begins ? ends.gap_1 : view.gap, cuts);
}

/// Other events in 3D are no roots of short polynomials: long paths are halved instead.
Cuts cuts_of(const PairPath<3>& path, const PairLaw<3>& law, const PairMeanGradient<3>& ends) {
    constexpr double long_path = 0.03;  // of the size of the pair
    Cuts cuts;
    if ((ends.energy_0 == 0.0) != (ends.energy_1 == 0.0)) cut_at_touch(path, law, ends, cuts);
    if (path.distance > long_path * path.size) cuts.insert(0.5);
    return cuts;
}

struct GaussRule {
    int points;
    std::array<double, 3> at;
    std::array<double, 3> weight;
};
constexpr GaussRule two_points{2, {0.21132486540518711775, 0.78867513459481288225}, {0.5, 0.5}};
constexpr GaussRule three_points{
    3, {0.11270166537925831148, 0.5, 0.88729833462074168852}, {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0}};

/// Faces that only translate have a force of degree 3 between events, in 2D and in 3D.
template <int Dim>
const GaussRule& rule_of(bool only_translates) {
    return Dim == 2 || only_translates ? two_points : three_points;
}

/// Adds the mean of dW/dz along the path.
template <int Dim>
void add_mean(const PairPath<Dim>& path, const Cuts& cuts, const PairNormals<Dim>& normals_0, const PairLaw<Dim>& law,
              PairCorners<Dim>& phi, PairMeanGradient<Dim>& result) {
    const bool only_translates = path.only_translates();
    const GaussRule& rule = rule_of<Dim>(only_translates);
    for (int piece = 0; piece < cuts.pieces; ++piece) {
        const double begin = cuts.at[piece], length = cuts.at[piece + 1] - begin;
        if (length == 0.0) continue;
        for (int k = 0; k < rule.points; ++k) {
            const PairCorners<Dim> z = path.at(begin + rule.at[k] * length);
            const PairEnergy<Dim> found = only_translates ? pair_energy<Dim>(normals_0, z, law, true)
                                                          : pair_energy<Dim>(PairNormals<Dim>(z), z, law, true);
            if (found.energy == 0.0) continue;
            const double weight = rule.weight[k] * length;
            for (std::size_t v = 0; v < phi.size(); ++v) {
                phi[v] += weight * found.gradient[v];
                result.pressure[v] += weight * found.pressure[v];
            }
            result.area += weight * found.area;
            result.active_share += weight;
        }
    }
}

/// Adds what closes the balance of energy along the motion; gives its size. Nothing where it is round-off of the energies
/// or, in steps that are nothing but round-off, of the force.
template <int Dim>
double close_balance(const PairPath<Dim>& path, double energy_0, double energy_1, PairCorners<Dim>& phi) {
    const double open = (energy_1 - energy_0) - dot<Dim>(phi, path.motion);
    const double of_energies = 8.0 * eps * (energy_0 + energy_1);
    if (std::abs(open) <= of_energies) return 0.0;
    if (path.distance <= 1e-6 * path.size && std::abs(open) <= of_energies + 8.0 * eps * largest_norm<Dim>(phi) * path.size)
        return 0.0;
    const double squared_motion = dot<Dim>(path.motion, path.motion);
    for (std::size_t v = 0; v < phi.size(); ++v) phi[v] += open / squared_motion * path.motion[v];
    return std::abs(open) / std::sqrt(squared_motion);
}

}  // namespace

template <int Dim>
PairMeanGradient<Dim> pair_mean_gradient(const PairCorners<Dim>& x_0, const PairCorners<Dim>& x_1, const PairLaw<Dim>& law,
                                         const PairPathOptions& options) {
    PairMeanGradient<Dim> result;
    result.gradient.fill(Vector<Dim>::Zero());
    if (facing_cosine<Dim>(x_0) >= law.facing.none && facing_cosine<Dim>(x_1) >= law.facing.none) return result;
    const PairFrame<Dim> start(x_0, law), end(x_1, law);
    const PairNormals<Dim> normals_0(start.z), normals_1(end.z);
    const PairEnergy<Dim> at_start = pair_energy<Dim>(normals_0, start.z, law, false);
    const PairEnergy<Dim> at_end = pair_energy<Dim>(normals_1, end.z, law, false);
    result.energy_0 = at_start.energy, result.energy_1 = at_end.energy;
    result.gap_0 = at_start.gap, result.gap_1 = at_end.gap;

    const PairPath<Dim> path(start, end);
    const Cuts cuts = options.events ? cuts_of(path, law, result) : Cuts{};
    PairCorners<Dim> phi;
    phi.fill(Vector<Dim>::Zero());
    add_mean<Dim>(path, cuts, normals_0, law, phi, result);
    if (result.active_share == 0.0 && result.energy_0 == 0.0 && result.energy_1 == 0.0) return result;
    result.events = cuts.pieces - 1;
    result.correction = close_balance<Dim>(path, result.energy_0, result.energy_1, phi);
    result.gradient = in_mean_frame<Dim>(start, end, law, phi);
    if (turns_over<Dim>(start, end)) result.gradient.fill(Vector<Dim>::Constant(std::numeric_limits<double>::quiet_NaN()));
    return result;
}

template PairMeanGradient<2> pair_mean_gradient(const PairCorners<2>&, const PairCorners<2>&, const PairLaw<2>&,
                                                const PairPathOptions&);
template PairMeanGradient<3> pair_mean_gradient(const PairCorners<3>&, const PairCorners<3>&, const PairLaw<3>&,
                                                const PairPathOptions&);

}  // namespace abut::geometry
