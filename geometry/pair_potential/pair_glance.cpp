#include "abut/geometry/pair_potential/pair_potential.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "abut/geometry/pair_potential/pair_normal.hpp"

namespace abut::geometry {
namespace {

/// Normals of both faces, of any length in 2D and for n with its lengths at rest.
std::array<Vector<2>, 2> weighed_normals(const PairCorners<2>& x, const PairLaw<2>& law) {
    const Vector<2> d_1 = (x[1] - x[0]) / law.length[0], d_2 = (x[3] - x[2]) / law.length[1];
    return {Vector<2>(d_1[1], -d_1[0]), Vector<2>(d_2[1], -d_2[0])};
}
std::array<Vector<3>, 2> weighed_normals(const PairCorners<3>& x, const PairLaw<3>&) {
    return {(x[1] - x[0]).cross(x[2] - x[0]).normalized(), (x[4] - x[3]).cross(x[5] - x[3]).normalized()};
}

/// n_1 . n_2 of these.
double cosine_of(const std::array<Vector<2>, 2>& normals) {
    return normals[0].dot(normals[1]) / (normals[0].norm() * normals[1].norm());
}
double cosine_of(const std::array<Vector<3>, 2>& normals) { return normals[0].dot(normals[1]); }

/// From the highest corner of face 1 to the lowest one of face 2 along a direction, without the digits that a position far
/// from the origin would cost.
template <int Dim>
double clearance(const PairCorners<Dim>& x, const Vector<Dim>& direction) {
    double highest = 0.0, lowest = direction.dot(x[Dim] - x[0]);
    for (int v = 1; v < Dim; ++v) {
        highest = std::max(highest, direction.dot(x[v] - x[0]));
        lowest = std::min(lowest, direction.dot(x[Dim + v] - x[0]));
    }
    return lowest - highest;
}

/// From the middle of face 1 to that of face 2, times Dim.
template <int Dim>
Vector<Dim> between_middles(const PairCorners<Dim>& x) {
    Vector<Dim> between = x[Dim] - x[0];
    for (int v = 1; v < Dim; ++v) between += x[Dim + v] - x[v];
    return between;
}

/// 1 - cos t of the sum t of two angles, whose sines have these squares.
double turn_of_both(double square_1, double square_2) {
    return (square_1 + square_2 - square_1 * square_2) / (1.0 + std::sqrt((1.0 - square_1) * (1.0 - square_2))) +
           std::sqrt(square_1 * square_2);
}

/// 1 - cos t of the largest turn t of the normal of a face while no corner moves by more than `reach`; 1 where no bound is
/// known.
double largest_turn(const Vector<2>* x, double reach) {
    const double square = 4.0 * reach * reach / (x[1] - x[0]).squaredNorm();
    return square < 1.0 ? turn_of_both(square, 0.0) : 1.0;
}
/// About the longest edge, and with it.
double largest_turn(const Vector<3>* x, double reach) {
    const Vector<3> u = x[1] - x[0], w = x[2] - x[0];
    const double longest = std::max({u.squaredNorm(), w.squaredNorm(), (w - u).squaredNorm()}),
                 with = 4.0 * reach * reach / longest, about = with * longest * longest / u.cross(w).squaredNorm();
    return about < 1.0 ? turn_of_both(about, with) : 1.0;
}

/// Largest change of the difference of both normals in n, which turn by up to t, given as 1 - cos t.
double largest_change(const PairLaw<2>& law, double, double reach) {
    return 2.0 * reach * (1.0 / law.length[0] + 1.0 / law.length[1]);
}
double largest_change(const PairLaw<3>&, double turn, double) { return std::sqrt(8.0 * turn); }

/// Face 2 before face 1: its clearance along n is how far all of face 2 is behind face 1.
template <int Dim>
PairCorners<Dim> behind(const PairCorners<Dim>& corners) {
    PairCorners<Dim> result;
    for (int v = 0; v < Dim; ++v) {
        result[v] = corners[Dim + v];
        result[Dim + v] = corners[v];
    }
    return result;
}

}  // namespace

template <int Dim>
PairOutlook<Dim> pair_outlook(const PairCorners<Dim>& corners, const PairLaw<Dim>& law, double reach, double depth) {
    PairOutlook<Dim> outlook;
    const auto normals = weighed_normals(corners, law);
    const double facing = cosine_of(normals),
                 turn = std::max(largest_turn(&corners[0], reach), largest_turn(&corners[Dim], reach));
    if (facing > law.facing.none &&
        std::acos(std::min(facing, 1.0)) + 4.0 * std::asin(std::sqrt(0.5 * turn)) < std::acos(law.facing.none)) {
        outlook.may_act = false;
        return outlook;
    }
    if (facing > no_normal_cosine) return outlook;
    const Vector<Dim> difference = normals[0] - normals[1];
    const double size = difference.norm(), sine = largest_change(law, turn, reach) / size;
    // the sine of the angle by which n can turn; short of a right angle what is apart along n stays apart
    if (!(sine < 1.0)) return outlook;
    const Vector<Dim> n = difference / size, between = between_middles<Dim>(corners);
    const Vector<Dim> aside = between - between.dot(n) * n;
    outlook.normal = n;
    outlook.aside_allowance = depth * sine;
    if (const double length = aside.norm(); length > 1e-6 * between.norm()) outlook.aside = aside / length;
    const double above = clearance<Dim>(corners, n);
    outlook.is_apart = above > 0.0;
    outlook.may_act = above <= 2.0 * reach && clearance<Dim>(behind<Dim>(corners), n) <= depth + law.offset + 2.0 * reach &&
                      clearance<Dim>(corners, outlook.aside) <= 2.0 * reach + outlook.aside_allowance;
    return outlook;
}

template <int Dim>
PairRest rests(const PairOutlook<Dim>& outlook, const PairCorners<Dim>& corners) {
    if (clearance<Dim>(corners, outlook.normal) > 0.0) return PairRest::apart;
    return clearance<Dim>(corners, outlook.aside) > outlook.aside_allowance ? PairRest::beside : PairRest::no;
}

template <int Dim>
PairPlacement<Dim> pair_placement(const PairCorners<Dim>& corners, const PairLaw<Dim>& law) {
    const auto normals = weighed_normals(corners, law);
    PairPlacement<Dim> found{PairPlace::unclear, cosine_of(normals), normals[0] - normals[1], 0.0, Vector<Dim>::Zero(), 0.0};
    if (found.facing >= law.facing.none) {
        found.place = PairPlace::turned_away;
        return found;
    }
    found.normal.normalize();
    found.above = clearance<Dim>(corners, found.normal);
    if (found.above + law.offset >= 0.0) {
        found.place = PairPlace::apart;
        return found;
    }
    const Vector<Dim> between = between_middles<Dim>(corners);
    found.aside = between - between.dot(found.normal) * found.normal;
    found.beside = clearance<Dim>(corners, found.aside);
    if (found.beside > 1e-14 * between.squaredNorm()) found.place = PairPlace::beside;
    return found;
}

// Clearance along one direction is a concave function along straight paths: what is clear along it at both ends stays so.
// Points that lie over each other along an n that has turned are apart along `aside` by no more than their height times the
// cosine between both; twice that at the end allows for n that turns unevenly.
template <int Dim>
bool stays_inactive(const PairPlacement<Dim>& at_start, const PairPlacement<Dim>& at_end, const PairCorners<Dim>& end) {
    if (at_start.place != at_end.place) return false;
    switch (at_start.place) {
        case PairPlace::apart:
            return clearance<Dim>(end, at_start.normal) >= 0.0;
        case PairPlace::beside: {
            const double turned = 2.0 * std::abs(at_start.aside.dot(at_end.normal));
            return std::min(at_start.beside, clearance<Dim>(end, at_start.aside)) >
                   -turned * std::min(at_start.above, at_end.above);
        }
        case PairPlace::turned_away:
            return true;
        case PairPlace::unclear:
            return false;
    }
    return false;
}

template PairOutlook<2> pair_outlook(const PairCorners<2>&, const PairLaw<2>&, double, double);
template PairOutlook<3> pair_outlook(const PairCorners<3>&, const PairLaw<3>&, double, double);
template PairRest rests(const PairOutlook<2>&, const PairCorners<2>&);
template PairRest rests(const PairOutlook<3>&, const PairCorners<3>&);
template PairPlacement<2> pair_placement(const PairCorners<2>&, const PairLaw<2>&);
template PairPlacement<3> pair_placement(const PairCorners<3>&, const PairLaw<3>&);
template bool stays_inactive(const PairPlacement<2>&, const PairPlacement<2>&, const PairCorners<2>&);
template bool stays_inactive(const PairPlacement<3>&, const PairPlacement<3>&, const PairCorners<3>&);

}  // namespace abut::geometry
