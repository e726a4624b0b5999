#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "abut/geometry/pair_potential/pair_slip.hpp"
#include "geometry/random_pairs.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::geometry;
using namespace abut::test;

namespace {

/// Where the slip of a pair is read, and where its force acts.
enum class SlipPoints {
    one,  ///< PairSlip: one point for both faces
    two,  ///< of each face the point at which it is pressed: as near as the faces are, and simpler
};

/// Motion of a pair past each other and its transpose, read at the pressed point of each face.
template <int Dim>
struct SlipAtTwoPoints {
    PairPressure<Dim> pressure;  ///< with sum 1 on each face

    explicit SlipAtTwoPoints(PairPressure<Dim> weights) : pressure(weights) {
        for (int face = 0; face < 2; ++face) {
            double sum = 0.0;
            for (int v = 0; v < Dim; ++v) sum += pressure[face * Dim + v];
            for (int v = 0; v < Dim; ++v) pressure[face * Dim + v] /= sum;
        }
    }
    [[nodiscard]] Vector<Dim> motion(const PairCorners<Dim>& by) const {
        Vector<Dim> motion = Vector<Dim>::Zero();
        for (int v = 0; v < Dim; ++v) motion += pressure[Dim + v] * by[Dim + v] - pressure[v] * by[v];
        return motion;
    }
    [[nodiscard]] PairCorners<Dim> on_corners(const Vector<Dim>& force) const {
        PairCorners<Dim> forces;
        for (int v = 0; v < Dim; ++v) {
            forces[v] = -pressure[v] * force;
            forces[Dim + v] = pressure[Dim + v] * force;
        }
        return forces;
    }
};

/// What a collision of two free facets did.
struct Impact {
    double h = 0.0;           ///< |H~ - H~0 + D| over H~0
    double momentum = 0.0;    ///< change over the sum of |p|
    double moment = 0.0;      ///< change of J~ over its size
    double dissipated = 0.0;  ///< over H~0
};

/// Two facets with a unit mass at each corner meet, turning, and slide with mu = 0.3 while they touch: MEMM, with the mean force of
/// the pair potential and J~ = sum [x + dt/(4 m) (p+ - p-)] x (p+ + p-)/2 of its steps (docs/method.md).
template <int Dim>
Impact collide(SlipPoints points) {
    const double dt = 2e-3, mu = 0.3;
    PairCorners<Dim> x, before;
    if constexpr (Dim == 2)
        x = {Vector<2>(0.9, 0.0), Vector<2>(-1.0, 0.05), Vector<2>(-0.7, 0.1), Vector<2>(1.1, 0.2)};
    else
        x = {Vector<3>(1.0, 0.0, 0.0),  Vector<3>(-0.5, 0.9, 0.03), Vector<3>(-0.6, -0.8, 0.0),
             Vector<3>(0.9, 0.1, 0.15), Vector<3>(-0.6, -0.7, 0.1), Vector<3>(-0.4, 0.9, 0.12)};
    const auto law = law_of<Dim>(x, 200.0);
    for (int v = 0; v < 2 * Dim; ++v) {
        const double side = v < Dim ? 1.0 : -1.0;
        before[v] = 0.5 * side * (Vector<Dim>::Unit(Dim - 1) - Vector<Dim>::Unit(0));
        if constexpr (Dim == 2)
            before[v] += 0.3 * Vector<2>(-x[v][1], x[v][0]);
        else
            before[v] += Vector<3>(0.1, 0.05, 0.3).cross(x[v]);
    }
    PairCorners<Dim> after = before;
    Impact impact;
    double dissipated = 0.0, h_0 = 0.0, size = 0.0, momenta = 0.0;
    AxialVector<Dim> moment_0 = AxialVector<Dim>::Zero();
    Vector<Dim> momentum_0 = Vector<Dim>::Zero();
    for (int step = 0; step <= 400; ++step) {
        double h = pair_gradient<Dim>(x, law).energy + dissipated;
        AxialVector<Dim> moment = AxialVector<Dim>::Zero();
        Vector<Dim> momentum = Vector<Dim>::Zero();
        for (int v = 0; v < 2 * Dim; ++v) {
            const Vector<Dim> arm = x[v] + 0.25 * dt * (after[v] - before[v]), mean = 0.5 * (before[v] + after[v]);
            h += 0.5 * before[v].dot(after[v]);
            moment += abut::moment<Dim>(arm, mean);
            momentum += mean;
            if (step == 0) size += arm.norm() * mean.norm(), momenta += mean.norm();
        }
        if (step == 0) h_0 = h, moment_0 = moment, momentum_0 = momentum;
        raise(impact.h, std::abs(h - h_0) / h_0);
        raise(impact.momentum, (momentum - momentum_0).norm() / momenta);
        raise(impact.moment, (moment - moment_0).norm() / size);

        PairCorners<Dim> x_1;
        for (int v = 0; v < 2 * Dim; ++v) x_1[v] = x[v] + dt * after[v];
        const auto normal = pair_mean_gradient<Dim>(x, x_1, law);
        PairCorners<Dim> force = normal.gradient;
        for (Vector<Dim>& of_corner : force) of_corner *= -1.0;
        if (normal.active_share > 0.0) {
            double normal_force = 0.0;
            for (int v = 0; v < Dim; ++v) normal_force += normal.pressure[v];
            const PairSlip<Dim> one(x, x_1, normal.pressure);
            const SlipAtTwoPoints<Dim> two(normal.pressure);
            Vector<Dim> motion = points == SlipPoints::one ? one.motion() : two.motion(difference<Dim>(x_1, x));
            motion -= one.normal() * one.normal().dot(motion);
            const Vector<Dim> friction = -mu * normal_force * motion.normalized();
            const PairCorners<Dim> on_corners =
                points == SlipPoints::one ? one.on_corners(friction) : two.on_corners(friction);
            for (int v = 0; v < 2 * Dim; ++v) force[v] += on_corners[v];
            dissipated -= friction.dot(motion);
        }
        for (int v = 0; v < 2 * Dim; ++v) {
            before[v] += 2.0 * dt * force[v];
            std::swap(before[v], after[v]);
        }
        x = x_1;
    }
    impact.dissipated = dissipated / h_0;
    return impact;
}

/// Two faces of size 1 of which each is a needle, down to a width of 1e-7, pressed into each other anyhow: by far more than that.
template <int Dim>
PairCorners<Dim> needles(std::mt19937& random) {
    PairCorners<Dim> x;
    for (Vector<Dim>& corner : x) {
        corner = random_vector<Dim>(random, 1.0);
        corner[Dim - 1] *= 0.2;
    }
    for (int face = 0; face < 2; ++face) {
        const double width = std::pow(10.0, uniform(random, -7.0, 0.0));
        const Vector<Dim>&first = x[Dim * face], &second = x[Dim * face + 1];
        const double along = Dim == 2 ? width : uniform(random, 0.0, 1.0);
        Vector<Dim> last = first + along * (second - first);
        if (Dim == 3) last += random_vector<Dim>(random, width);
        x[Dim * face + Dim - 1] = last;
    }
    return x;
}

}  // namespace

/// Forces on the corners are the transpose of the slip: that they have no sum, no moment and do its work is of needles as of others.
TEMPLATE_TEST_CASE_SIG(
    "the slip of needles is within the motion of their corners, and its forces are those of a point on them",
    "[pair_potential][friction]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(7);
    int pressed = 0, clipped = 0;
    double beyond = 0.0, largest = 0.0, sum = 0.0, moment = 0.0, work = 0.0, turning = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        const auto x_0 = needles<Dim>(random);
        auto x_1 = x_0;
        for (Vector<Dim>& corner : x_1) corner += random_vector<Dim>(random, 1e-3);
        const auto normal = pair_mean_gradient<Dim>(x_0, x_1, law_of<Dim>(x_0));
        if (!(normal.area > 0.0 && normal.active_share > 0.0)) continue;
        const PairSlip<Dim> slip(x_0, x_1, normal.pressure);
        ++pressed, clipped += slip.is_clipped() ? 1 : 0;

        double farthest = 0.0;
        for (int v = 0; v < Dim; ++v)
            for (int w = Dim; w < 2 * Dim; ++w) raise(farthest, ((x_1[w] - x_0[w]) - (x_1[v] - x_0[v])).norm());
        const Vector<Dim> along = slip.motion() - slip.normal() * slip.normal().dot(slip.motion());
        raise(beyond, along.norm() / farthest - 1.0);

        const Vector<Dim> force = slip.tangents(0) * PlaneVector<Dim>::Unit(0);
        const auto on_corners = slip.on_corners(force);
        Vector<Dim> sum_of_forces = Vector<Dim>::Zero();
        AxialVector<Dim> sum_of_moments = AxialVector<Dim>::Zero();
        double done = 0.0;
        for (int v = 0; v < 2 * Dim; ++v) {
            sum_of_forces += on_corners[v];
            sum_of_moments += abut::moment<Dim>(Vector<Dim>(0.5 * (x_0[v] + x_1[v])), on_corners[v]);
            done += on_corners[v].dot(x_1[v] - x_0[v]);
            raise(largest, on_corners[v].norm());
        }
        raise(sum, sum_of_forces.norm());
        raise(moment, sum_of_moments.norm());
        raise(work, std::abs(done - force.dot(slip.motion())) / farthest);

        const Matrix<Dim> turn = random_turn<Dim>(random, 1.0);
        auto turned = x_0;
        for (Vector<Dim>& corner : turned) corner = turn * corner;
        raise(turning, PairSlip<Dim>(x_0, turned, normal.pressure).motion().norm());
    }
    CHECK(pressed > 5000);
    CHECK(clipped > 1000);
    CHECK(beyond <= 1e-12);
    CHECK(largest <= 2.0);
    CHECK(sum <= 1e-14);
    CHECK(moment <= 1e-14);
    CHECK(work <= 1e-13);
    CHECK(turning <= 1e-10);
}

TEMPLATE_TEST_CASE_SIG("faces that are pressed in by less than they are wide slip unclipped", "[pair_potential][friction]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(8);
    int pressed = 0, clipped = 0;
    double off = 0.0;
    for (int i = 0; i < 10'000; ++i) {
        const auto x_0 = random_pair<Dim>(random), x_1 = moved_on<Dim>(x_0, random, 1e-2, 1e-2);
        const auto normal = pair_mean_gradient<Dim>(x_0, x_1, law_of<Dim>(x_0));
        if (!(normal.area > 0.0 && normal.active_share > 0.0)) continue;
        const PairSlip<Dim> slip(x_0, x_1, normal.pressure);
        ++pressed, clipped += slip.is_clipped() ? 1 : 0;
        Vector<Dim> middle = Vector<Dim>::Zero();  // between the points where the faces press
        for (int face = 0; face < 2; ++face) {
            double all = 0.0;
            for (int v = Dim * face; v < Dim * (face + 1); ++v) all += normal.pressure[v];
            for (int v = Dim * face; v < Dim * (face + 1); ++v)
                middle += 0.5 * normal.pressure[v] / all * 0.5 * (x_0[v] + x_1[v]);
        }
        raise(off, (slip.point() - middle).norm());
    }
    CHECK(pressed > 5000);
    CHECK(clipped == 0);
    CHECK(off <= 1e-14);
}

TEMPLATE_TEST_CASE_SIG("a slip read at one point of a pair keeps J~ in an impact; read at two, it moves J~ and nothing else",
                       "[pair_potential][friction]", ((int Dim), Dim), 2, 3) {
    const Impact right = collide<Dim>(SlipPoints::one), wrong = collide<Dim>(SlipPoints::two);
    CHECK(right.dissipated > 0.01);
    CHECK(wrong.dissipated > 0.01);
    for (const Impact& impact : {right, wrong}) {
        CHECK(impact.h < 1e-13);
        CHECK(impact.momentum < 1e-14);
    }
    CHECK(right.moment < 1e-14);
    CHECK(wrong.moment > 1e-6);
}
