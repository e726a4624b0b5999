#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "abut/base/rotation.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "geometry/random_pairs.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::geometry;
using namespace abut::test;

namespace {

/// |f| of a pair of this energy may be so small that only what W itself rounds to counts.
template <int Dim>
double scale(const PairMeanGradient<Dim>& found, const PairCorners<Dim>& motion) {
    return found.energy_0 + found.energy_1 + norm_of<Dim>(found.gradient) * norm_of<Dim>(motion);
}

/// Whether the line from a point meets a triangle, and how far along it.
bool ray_hits(const Vector<3>& from, const Vector<3>& along, const Vector<3>* triangle, double& height) {
    const auto system = Matrix<3>::from_columns(triangle[1] - triangle[0], triangle[2] - triangle[0], -along);
    const Vector<3> solution = system.inverse() * (from - triangle[0]);
    height = solution[2];
    return solution[0] >= 0.0 && solution[1] >= 0.0 && solution[0] + solution[1] <= 1.0;
}

/// Two faces over each other, a bit turned and shifted in themselves.
template <int Dim>
PairCorners<Dim> facing_at(double gap) {
    if constexpr (Dim == 2)
        return {Vector<2>(1.0, 0.0), Vector<2>(0.0, 0.0), Vector<2>(0.2, gap), Vector<2>(1.1, gap)};
    else
        return {Vector<3>(0.0, 0.0, 0.0), Vector<3>(1.0, 0.0, 0.0), Vector<3>(0.0, 1.0, 0.0),
                Vector<3>(0.1, 0.1, gap), Vector<3>(0.2, 1.1, gap), Vector<3>(1.1, 0.0, gap)};
}

/// A pair whose corners have the mass 1 and springs of stiffness 1 to where it is pressed in, by the scheme MEMM
/// (docs/method.md, Time): it bounces.
template <int Dim>
class BouncingPair {
public:
    explicit BouncingPair(double dt) : dt_(dt) {
        x_[0][Dim - 1] -= 0.03;
        x_[Dim][0] += 0.02;
        const PairCorners<Dim> gradient = pair_gradient<Dim>(x_, law_).gradient;
        for (int v = 0; v < 2 * Dim; ++v) {
            after_[v] = -0.5 * dt * (gradient[v] + x_[v] - held_at_[v]);
            before_[v] = -after_[v];
        }
    }
    void step() {
        PairCorners<Dim> next = x_;
        for (int v = 0; v < 2 * Dim; ++v) next[v] += dt_ * after_[v];
        const auto found = pair_mean_gradient<Dim>(x_, next, law_);
        if (found.energy_0 == 0.0 && found.energy_1 > 0.0) ++bounces_;
        for (int v = 0; v < 2 * Dim; ++v)
            before_[v] -= 2.0 * dt_ * (found.gradient[v] + 0.5 * (x_[v] + next[v]) - held_at_[v]);
        std::swap(before_, after_);
        x_ = next;
    }
    [[nodiscard]] double pseudo_energy() const {
        double energy = pair_state<Dim>(x_, law_).energy + 0.5 * product<Dim>(before_, after_);
        for (int v = 0; v < 2 * Dim; ++v) energy += 0.5 * (x_[v] - held_at_[v]).squaredNorm();
        return energy;
    }
    [[nodiscard]] int bounces() const { return bounces_; }

private:
    PairLaw<Dim> law_{.stiffness = 20.0};
    double dt_;
    PairCorners<Dim> held_at_ = facing_at<Dim>(-0.1), x_ = facing_at<Dim>(0.1), before_, after_;
    int bounces_ = 0;
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("work of the mean gradient is the change of W, for steps of any size", "[pair_potential]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(1);
    double balance = 0.0, momentum = 0.0, moments = 0.0;
    int active = 0;
    for (const double size : {1e-4, 0.03, 1.0})
        for (int i = 0; i < 20000; ++i) {
            const PairCorners<Dim> x_0 = random_pair<Dim>(random), x_1 = moved_on<Dim>(x_0, random, size, 0.1 * size);
            const auto found = pair_mean_gradient<Dim>(x_0, x_1, law_of<Dim>(x_0));
            if (found.active_share == 0.0) continue;
            ++active;
            const PairCorners<Dim> motion = difference<Dim>(x_1, x_0);
            const double force = norm_of<Dim>(found.gradient);
            const double work = product<Dim>(found.gradient, motion) - (found.energy_1 - found.energy_0);
            raise(balance, std::abs(work) / (scale<Dim>(found, motion) + 0.02 * force));
            raise(momentum, sum_of<Dim>(found.gradient).norm() / force);
            raise(moments, moment<Dim>(x_0, x_1, found.gradient) / force);
        }
    CHECK(active > 10000);
    CHECK(balance < 1e-13);
    CHECK(momentum < 5e-15);
    CHECK(moments < 5e-15);
}

TEMPLATE_TEST_CASE_SIG("the gradient is that of W, by central differences", "[pair_potential]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(2);
    double worst = 0.0;
    int active = 0;
    for (int i = 0; i < 3000; ++i) {
        const PairCorners<Dim> x = random_pair<Dim>(random);
        PairLaw<Dim> law = law_of<Dim>(x);
        if (i % 2 == 1) law.facing = {-0.9, -0.05};
        const auto exact = pair_gradient<Dim>(x, law);
        if (exact.energy < 1e-4) continue;
        ++active;
        const double h = 1e-6;
        for (std::size_t v = 0; v < x.size(); ++v)
            for (int d = 0; d < Dim; ++d) {
                PairCorners<Dim> more = x, less = x;
                more[v][d] += h;
                less[v][d] -= h;
                const double slope = (pair_gradient<Dim>(more, law).energy - pair_gradient<Dim>(less, law).energy) / (2 * h);
                raise(worst, std::abs(slope - exact.gradient[v][d]) / (norm_of<Dim>(exact.gradient) + 0.1));
            }
    }
    CHECK(active > 500);
    CHECK(worst < 2e-8);
}

TEMPLATE_TEST_CASE_SIG("W is the same for both orders of the faces and wherever the pair is turned to", "[pair_potential]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    double exchange = 0.0, turn = 0.0, ends = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const PairCorners<Dim> x_0 = random_pair<Dim>(random), x_1 = moved_on<Dim>(x_0, random, 0.03, 0.01);
        PairLaw<Dim> law = law_of<Dim>(x_0), law_of_exchanged = law;
        std::swap(law_of_exchanged.length[0], law_of_exchanged.length[1]);
        const auto found = pair_mean_gradient<Dim>(x_0, x_1, law);
        const double force = norm_of<Dim>(found.gradient);
        if (force < 1e-3) continue;

        const auto other = pair_mean_gradient<Dim>(exchanged<Dim>(x_0), exchanged<Dim>(x_1), law_of_exchanged);
        raise(exchange, std::abs(other.energy_0 - found.energy_0) / force);
        const auto gradient = pair_gradient<Dim>(x_0, law),
                   of_exchanged = pair_gradient<Dim>(exchanged<Dim>(x_0), law_of_exchanged);
        raise(exchange, norm_of<Dim>(difference<Dim>(exchanged<Dim>(of_exchanged.gradient), gradient.gradient)) / force);

        const auto back = pair_mean_gradient<Dim>(x_1, x_0, law);
        raise(ends, norm_of<Dim>(difference<Dim>(back.gradient, found.gradient)) / force);

        const Matrix<Dim> by = random_turn<Dim>(random, 3.0);
        const Vector<Dim> along = random_vector<Dim>(random, 1.0);
        PairCorners<Dim> y_0, y_1, turned_back;
        for (std::size_t v = 0; v < x_0.size(); ++v) {
            y_0[v] = by * x_0[v] + along;
            y_1[v] = by * x_1[v] + along;
        }
        const auto turned = pair_mean_gradient<Dim>(y_0, y_1, law);
        for (std::size_t v = 0; v < x_0.size(); ++v) turned_back[v] = by.transpose() * turned.gradient[v];
        raise(turn, std::abs(turned.energy_0 - found.energy_0) / force);
        raise(turn, norm_of<Dim>(difference<Dim>(turned_back, found.gradient)) / force);
    }
    CHECK(exchange < 1e-12);
    CHECK(ends < 1e-12);
    CHECK(turn < 1e-12);
}

TEMPLATE_TEST_CASE_SIG("in steps that are nothing but rounding the mean gradient is the gradient", "[pair_potential]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(4);
    double worst = 0.0;
    for (const double size : {0.0, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14})
        for (int i = 0; i < 2000; ++i) {
            PairCorners<Dim> x_0 = random_pair<Dim>(random), x_1 = x_0;
            for (Vector<Dim>& corner : x_1) corner += random_vector<Dim>(random, size);
            const PairLaw<Dim> law = law_of<Dim>(x_0);
            const auto mean = pair_mean_gradient<Dim>(x_0, x_1, law);
            const auto plain = pair_gradient<Dim>(x_0, law);
            if (plain.energy == 0.0) continue;
            raise(worst,
                  norm_of<Dim>(difference<Dim>(mean.gradient, plain.gradient)) / (norm_of<Dim>(plain.gradient) + 1e-3));
        }
    CHECK(worst < 1e-11);
}

TEST_CASE("W of two triangles is k/2 times the integral of min(g, 0)^2 by a sum over rays", "[pair_potential]") {
    std::mt19937 random(5);
    int active = 0;
    for (int i = 0; i < 200; ++i) {
        const PairCorners<3> x = random_pair<3>(random);
        const Vector<3> n_1 = (x[1] - x[0]).cross(x[2] - x[0]).normalized(),
                        n_2 = (x[4] - x[3]).cross(x[5] - x[3]).normalized();
        if (n_1.dot(n_2) > FacingFade{}.full) continue;
        const auto found = pair_gradient<3>(x, {.stiffness = 2.0});
        const Vector<3> n = (n_1 - n_2).normalized(), t = n.unitOrthogonal(), s = n.cross(t);
        constexpr int m = 200;
        const double step = 5.0 / m;
        double sum = 0.0, area = 0.0;
        for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b) {
                const Vector<3> from = x[0] + (-2.5 + (a + 0.5) * step) * t + (-2.5 + (b + 0.5) * step) * s;
                double h_1 = 0.0, h_2 = 0.0;
                if (!ray_hits(from, n, &x[0], h_1) || !ray_hits(from, n, &x[3], h_2) || h_2 >= h_1) continue;
                sum += (h_2 - h_1) * (h_2 - h_1) * step * step;  // k/2 = 1
                area += step * step;
            }
        if (found.area > 0.1) ++active;
        CHECK(found.energy == Approx(sum).margin(3e-3));
        CHECK(found.area == Approx(area).margin(3e-2));
    }
    CHECK(active > 30);
}

TEST_CASE("parallel faces at one depth: W = k/2 g^2 times the overlap, in closed form", "[pair_potential]") {
    const double k = 3.0, g = -0.01;
    // Face 2 covers the part 0 < x < 0.25 of a segment of length 1, then slides out past its end.
    for (const double shift : {0.0, 0.5, 0.9}) {
        const PairCorners<2> x{Vector<2>(1, 0), Vector<2>(0, 0), Vector<2>(shift, g), Vector<2>(shift + 0.25, g)};
        const double overlap = std::min(1.0, shift + 0.25) - shift;
        const auto state = pair_state<2>(x, {.stiffness = k, .length = {1.0, 0.25}});
        CHECK(state.energy == Approx(0.5 * k * g * g * overlap).epsilon(1e-12));
        CHECK(state.overlap == Approx(overlap).epsilon(1e-12));
        CHECK(state.gap == Approx(g).epsilon(1e-12));
        CHECK((state.normal - Vector<2>(0, 1)).norm() < 1e-15);
    }
    // A right triangle of legs 1 over the same from the other side, moved along x: what is left has legs 1 - s.
    for (const double s : {0.0, 0.3, 0.7}) {
        const PairCorners<3> x{Vector<3>(0, 0, 0), Vector<3>(1, 0, 0), Vector<3>(0, 1, 0),
                               Vector<3>(s, 0, g), Vector<3>(s, 1, g), Vector<3>(s + 1, 0, g)};
        const auto state = pair_state<3>(x, {.stiffness = k});
        const double overlap = 0.5 * (1 - s) * (1 - s);
        CHECK(state.energy == Approx(0.5 * k * g * g * overlap).epsilon(1e-12));
        CHECK(state.overlap == Approx(overlap).epsilon(1e-12));
        CHECK((state.normal - Vector<3>(0, 0, 1)).norm() < 1e-15);
    }
}

TEST_CASE("of faces that lie beside each other the gap is halfway between them", "[pair_potential]") {
    const double g = 0.2;
    const PairCorners<2> segments{Vector<2>(1, 0), Vector<2>(0, 0), Vector<2>(1.5, g), Vector<2>(2.5, g)};
    CHECK(pair_state<2>(segments, {.stiffness = 1.0}).gap == Approx(g).epsilon(1e-12));
    CHECK(pair_state<2>(segments, {.stiffness = 1.0}).overlap == 0.0);
    const PairCorners<3> triangles{Vector<3>(0, 0, 0), Vector<3>(1, 0, 0), Vector<3>(0, 1, 0),
                                   Vector<3>(2, 2, g), Vector<3>(2, 3, g), Vector<3>(3, 2, g)};
    CHECK(pair_state<3>(triangles, {.stiffness = 1.0}).gap == Approx(g).epsilon(1e-12));
    // Both tilted: at x = 1.25, halfway, each face has come 0.25 farther than at its end, at slopes of -0.1 and 0.1.
    const PairCorners<2> roof{Vector<2>(1, 0), Vector<2>(0, 0.1), Vector<2>(1.5, g), Vector<2>(2.5, g + 0.1)};
    CHECK(pair_state<2>(roof, {.stiffness = 1.0, .length = {std::sqrt(1.01), std::sqrt(1.01)}}).gap ==
          Approx(g - 0.025 + 0.025).epsilon(1e-12));
    // Faces that look the same way have no gap.
    CHECK(pair_state<2>({Vector<2>(1, 0), Vector<2>(0, 0), Vector<2>(1, 1), Vector<2>(0, 1)}, {.stiffness = 1.0}).gap ==
          std::numeric_limits<double>::infinity());
}

TEST_CASE("a weight without steps leads from full stiffness to none as faces turn away", "[pair_potential]") {
    // Face 2 of a wedge is turned about the middle of face 1 by an angle, so that n_1 . n_2 = -cos(angle).
    const FacingFade fade = GENERATE(FacingFade{}, FacingFade{-0.3, -0.05});
    const PairLaw<2> law{.stiffness = 1.0, .facing = fade};
    double before = std::numeric_limits<double>::infinity(), largest_step = 0.0, first = 0.0;
    for (double angle = 0.0; angle < 2.0; angle += 1e-3) {
        const Vector<2> half = 0.5 * Vector<2>(std::cos(angle), std::sin(angle)), down(0.0, -0.1);
        const auto state = pair_state<2>({Vector<2>(0.5, 0), Vector<2>(-0.5, 0), down - half, down + half}, law);
        CHECK(state.facing == Approx(-std::cos(angle)).margin(1e-12));
        if (-std::cos(angle) >= fade.none) CHECK(state.energy == 0.0);
        if (-std::cos(angle) < fade.none - 1e-3) CHECK(state.energy > 0.0);
        if (angle == 0.0) first = state.energy;
        if (std::isfinite(before)) raise(largest_step, std::abs(state.energy - before));
        before = state.energy;
    }
    CHECK(first == Approx(0.5 * 0.1 * 0.1).epsilon(1e-12));
    CHECK(largest_step < 0.01 / (fade.none - fade.full) * first);
}

TEST_CASE("a face that loses its area along a step leaves a finite normal, in any unit", "[pair_potential]") {
    const double unit = GENERATE(1.0, 1e-74), left = GENERATE(1e-8, 1e-13, 1e-14, 1e-16, 0.0);
    PairCorners<3> x_0{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -0.01}, {0, 1, -0.01}, {1, 0, -0.01}}};
    PairCorners<3> x_1 = x_0;
    x_1[5] = {left, 0.5, -0.01};
    for (auto* x : {&x_0, &x_1})
        for (Vector<3>& corner : *x) corner = unit * corner;
    CHECK(pair_mean_gradient<3>(x_0, x_1, {.stiffness = 1.0}).normal.allFinite());
}

TEMPLATE_TEST_CASE_SIG("needles and faces nearly on edge give finite forces", "[pair_potential]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(6);
    int active = 0;
    for (const double thin : {1e-2, 1e-4, 1e-6})
        for (int i = 0; i < 3000; ++i) {
            PairCorners<Dim> x_0 = random_pair<Dim>(random);
            x_0[Dim - 1] = x_0[0] + (1.0 - thin) * (x_0[1] - x_0[0]) + thin * (x_0[Dim - 1] - x_0[0]);  // 3D: a needle
            if constexpr (Dim == 2) x_0[1] = x_0[0] + thin * (x_0[1] - x_0[0]);                         // 2D: a short face
            const auto found = pair_mean_gradient<Dim>(x_0, moved_on<Dim>(x_0, random, 0.01, 1e-3), law_of<Dim>(x_0));
            if (found.active_share > 0.0) ++active;
            REQUIRE(std::isfinite(norm_of<Dim>(found.gradient)));
            REQUIRE(norm_of<Dim>(found.gradient) < 1e3);
        }
    CHECK(active > 1000);
}

TEMPLATE_TEST_CASE_SIG("a pair of faces that only translate keeps energy and momenta by its cheaper path",
                       "[pair_potential]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(7);
    double balance = 0.0, against = 0.0, forces = 0.0, moments = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const PairCorners<Dim> x_0 = random_pair<Dim>(random);
        const Vector<Dim> by = random_vector<Dim>(random, 0.02);
        PairCorners<Dim> x_1 = x_0, slightly_turned = x_0;
        for (int v = 0; v < Dim; ++v) x_1[v] += by;
        slightly_turned = x_1;
        slightly_turned[0] += 1e-11 * Vector<Dim>::Ones();  // enough for the general path
        const auto found = pair_mean_gradient<Dim>(x_0, x_1, law_of<Dim>(x_0));
        const double force = norm_of<Dim>(found.gradient);
        if (force < 1e-3) continue;
        const PairCorners<Dim> motion = difference<Dim>(x_1, x_0);
        const double work = product<Dim>(found.gradient, motion) - (found.energy_1 - found.energy_0);
        raise(balance, std::abs(work) / (scale<Dim>(found, motion) + 0.02 * force));
        raise(moments, moment<Dim>(x_0, x_1, found.gradient) / force);
        const auto general = pair_mean_gradient<Dim>(x_0, slightly_turned, law_of<Dim>(x_0));
        against += norm_of<Dim>(difference<Dim>(general.gradient, found.gradient));
        forces += force;
    }
    CHECK(balance < 1e-13);
    CHECK(moments < 5e-15);
    CHECK(against < 1e-3 * forces);
}

TEST_CASE("without its correction a step loses energy, and events make the loss small", "[pair_potential]") {
    std::mt19937 random(8);
    double with_events = 0.0, without = 0.0, force = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const PairCorners<2> x_0 = random_pair<2>(random), x_1 = moved_on<2>(x_0, random, 0.03, 0.003);
        const auto found = pair_mean_gradient<2>(x_0, x_1, law_of<2>(x_0), {.gauss = true});
        with_events += found.correction;
        without += pair_mean_gradient<2>(x_0, x_1, law_of<2>(x_0), {.events = false, .gauss = true}).correction;
        force += norm_of<2>(found.gradient);
    }
    CHECK(with_events > 1e-12 * force);
    CHECK(with_events < 1e-4 * force);
    CHECK(without > 3.0 * with_events);
}

TEST_CASE("triangles that meet or part all at once press by the exact mean over the step", "[pair_potential]") {
    // The force of a uniform gap is k A min(g, 0); its mean over a step from g_0 > 0 to g_1 < 0 is k A g_1^2/2 / (g_1 -
    // g_0).
    const double g_0 = GENERATE(1e-3, 0.02, 0.3), g_1 = GENERATE(-1e-3, -0.02, -0.1);
    const bool parts = GENERATE(false, true);
    const auto triangles = [](double gap) {
        return PairCorners<3>{Vector<3>(0, 0, 0),   Vector<3>(1, 0, 0),   Vector<3>(0, 1, 0),
                              Vector<3>(0, 0, gap), Vector<3>(0, 1, gap), Vector<3>(1, 0, gap)};
    };
    const auto found = parts ? pair_mean_gradient<3>(triangles(g_1), triangles(g_0), {.stiffness = 3.0})
                             : pair_mean_gradient<3>(triangles(g_0), triangles(g_1), {.stiffness = 3.0});
    const double expected = 3.0 * 0.5 * 0.5 * g_1 * g_1 / (g_1 - g_0);
    const Vector<3> on_second = found.gradient[3] + found.gradient[4] + found.gradient[5];
    CHECK(on_second[2] == Approx(expected).epsilon(1e-12));
    CHECK(on_second.head<2>().norm() < 1e-12 * std::abs(expected));
    CHECK(found.correction < 1e-12 * std::abs(expected));
}

TEST_CASE("sizes of 1e-9 and 1e9 change nothing but the unit", "[pair_potential]") {
    std::mt19937 random(9);
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const PairCorners<3> x_0 = random_pair<3>(random), x_1 = moved_on<3>(x_0, random, 0.03, 0.003);
        const auto found = pair_mean_gradient<3>(x_0, x_1, {.stiffness = 1.0});
        if (norm_of<3>(found.gradient) < 1e-3) continue;
        for (const double size : {1e-9, 1e9}) {
            PairCorners<3> y_0 = x_0, y_1 = x_1;
            for (auto* corners : {&y_0, &y_1})
                for (Vector<3>& corner : *corners) corner *= size;
            const auto scaled = pair_mean_gradient<3>(y_0, y_1, {.stiffness = 1.0});
            raise(worst, std::abs(scaled.energy_0 / std::pow(size, 4) - found.energy_0) / found.energy_0);
        }
    }
    CHECK(worst < 1e-9);
}

TEMPLATE_TEST_CASE_SIG("a pair that is apart, beside or turned away at a glance has no energy", "[pair_potential]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(10);
    std::array<int, 4> seen{};
    int unclear_without_energy = 0;
    for (int i = 0; i < 20000; ++i) {
        PairCorners<Dim> x = random_pair<Dim>(random);
        const Vector<Dim> by = random_vector<Dim>(random, 1.0);
        const Matrix<Dim> turn = random_turn<Dim>(random, 2.5);
        for (int v = 0; v < Dim; ++v) x[v] = turn * (x[v] - x[Dim]) + x[Dim] + by;
        const auto glance = pair_placement<Dim>(x, law_of<Dim>(x));
        const auto state = pair_state<Dim>(x, law_of<Dim>(x));
        ++seen[static_cast<std::size_t>(glance.place)];
        REQUIRE(glance.facing == Approx(state.facing).margin(1e-14));
        if (glance.place != PairPlace::unclear) REQUIRE(state.energy == 0.0);
        if (glance.place == PairPlace::apart && state.overlap > 0.0) REQUIRE(state.gap >= -1e-14);
        if (glance.place == PairPlace::beside) REQUIRE(state.overlap == 0.0);
        if (glance.place == PairPlace::unclear && state.energy == 0.0) ++unclear_without_energy;
        if (glance.place == PairPlace::unclear) REQUIRE((glance.normal - state.normal).norm() < 1e-13);
    }
    for (const int count : seen) CHECK(count > 100);
    CHECK(unclear_without_energy < seen[static_cast<std::size_t>(PairPlace::unclear)]);
}

TEMPLATE_TEST_CASE_SIG("a pair that is told to stay inactive along a step has no force in it", "[pair_potential]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(12);
    int told = 0, moved_past = 0;
    for (int i = 0; i < 40000; ++i) {
        PairCorners<Dim> x_0 = random_pair<Dim>(random);
        const Vector<Dim> by = random_vector<Dim>(random, 1.5);
        for (int v = 0; v < Dim; ++v) x_0[v] += by;
        const PairCorners<Dim> x_1 = moved_on<Dim>(x_0, random, 0.3, i % 2 == 0 ? 0.05 : 0.6);
        const PairLaw<Dim> law = law_of<Dim>(x_0);
        const auto at_start = pair_placement<Dim>(x_0, law), at_end = pair_placement<Dim>(x_1, law);
        const bool inactive = stays_inactive<Dim>(at_start, at_end, x_1);
        const auto found = pair_mean_gradient<Dim>(x_0, x_1, law);
        if (inactive) ++told;
        if (!inactive && at_start.place != PairPlace::unclear && at_end.place != PairPlace::unclear) ++moved_past;
        if (inactive) REQUIRE(found.active_share == 0.0);
    }
    CHECK(told > 1000);
    CHECK(moved_past > 100);
}

TEMPLATE_TEST_CASE_SIG("an outlook holds wherever the corners go within reach", "[pair_potential]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(11);
    int left_out = 0, kept = 0, apart = 0, beside = 0;
    for (int i = 0; i < 4000; ++i) {
        PairCorners<Dim> x = random_pair<Dim>(random);
        const Vector<Dim> by = random_vector<Dim>(random, 1.5);
        const Matrix<Dim> turn = random_turn<Dim>(random, 2.5);
        for (int v = 0; v < Dim; ++v) x[v] = turn * (x[v] - x[Dim]) + x[Dim] + by;
        const PairLaw<Dim> law = law_of<Dim>(x);
        const double reach = uniform(random, 0.0, 0.3), depth = uniform(random, 0.0, 1.0);
        const auto outlook = pair_outlook<Dim>(x, law, reach, depth);
        ++(outlook.may_act ? kept : left_out);
        for (int j = 0; j < 40; ++j) {
            PairCorners<Dim> moved = x;
            for (Vector<Dim>& corner : moved) corner += reach * random_vector<Dim>(random, 1.0).normalized();
            const auto state = pair_state<Dim>(moved, law);
            const PairRest rest = rests<Dim>(outlook, moved);
            const bool without_energy = state.energy == 0.0 || state.gap < -depth;
            if (!outlook.may_act) REQUIRE(without_energy);
            if (rest == PairRest::apart) REQUIRE(state.energy == 0.0);
            if (rest == PairRest::beside) REQUIRE(without_energy);
            apart += rest == PairRest::apart ? 1 : 0;
            beside += rest == PairRest::beside ? 1 : 0;
        }
    }
    CHECK(left_out > 1000);
    CHECK(kept > 500);
    CHECK(apart > 1000);
    CHECK(beside > 1000);
}

TEST_CASE("two triangles on both sides of a shared edge have no energy, wherever they are turned to", "[pair_potential]") {
    std::mt19937 random(20);
    double energy = 0.0, force = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const Matrix<3> turn = random_turn<3>(random, 3.0);
        const Vector<3> by = random_vector<3>(random, 1.0);
        const Vector<3> a = turn * Vector<3>(0, 0, 0) + by, b = turn * Vector<3>(0.3, 0.2, 0) + by,
                        c = turn * Vector<3>(-0.1, 0.25, 0) + by, d = turn * Vector<3>(0.2, -0.2, 0) + by;
        // face 1 is (a, b, c), face 2 looks against it on the other side of the edge from a to b
        const PairCorners<3> x_0{a, b, c, d, b, a};
        PairCorners<3> x_1 = x_0;
        for (const auto& [one, other] : {std::pair(0, 5), std::pair(1, 4), std::pair(2, 2), std::pair(3, 3)})
            x_1[one] = x_1[other] = x_0[one] + random_vector<3>(random, i % 2 == 0 ? 1e-10 : 1e-3);
        const auto found = pair_mean_gradient<3>(x_0, x_1, {.stiffness = 20.0});
        raise(energy, std::abs(found.energy_0));
        raise(energy, std::abs(found.energy_1));
        raise(force, norm_of<3>(found.gradient));
        (void)pair_state<3>(x_1, {.stiffness = 20.0});
    }
    CHECK(energy < 1e-12);
    CHECK(force < 1e-8);
}

TEMPLATE_TEST_CASE_SIG("a pressed pair that turns by half a turn in a step has no force that keeps momenta: it is no number",
                       "[pair_potential]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(21);
    int active = 0;
    for (int i = 0; i < 200; ++i) {
        const PairCorners<Dim> x_0 = random_pair<Dim>(random);
        if (pair_gradient<Dim>(x_0, law_of<Dim>(x_0)).energy < 1e-6) continue;
        ++active;
        PairCorners<Dim> half = x_0, less = x_0;
        Matrix<Dim> turn = -Matrix<Dim>::Identity();  // 3D: about e_3
        if constexpr (Dim == 3) turn(2, 2) = 1.0;
        Matrix<Dim> nearly = turn;
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column < 2; ++column) nearly(row, column) = rotation_in_plane(3.0)(row, column);
        for (std::size_t v = 0; v < x_0.size(); ++v) half[v] = turn * x_0[v], less[v] = nearly * x_0[v];
        if constexpr (Dim == 3) {  // about the normal of face 1, whose first edge then turns over
            const Vector<3> normal = (x_0[1] - x_0[0]).cross(x_0[2] - x_0[0]).normalized();
            for (std::size_t v = 0; v < x_0.size(); ++v) half[v] = 2.0 * normal.dot(x_0[v]) * normal - x_0[v];
        }
        CHECK(std::isnan(pair_mean_gradient<Dim>(x_0, half, law_of<Dim>(x_0)).gradient[0][0]));
        const auto found = pair_mean_gradient<Dim>(x_0, less, law_of<Dim>(x_0));
        CHECK(sum_of<Dim>(found.gradient).norm() < 1e-11 * norm_of<Dim>(found.gradient) + 1e-15);
    }
    CHECK(active > 30);
}

TEMPLATE_TEST_CASE_SIG("over a million steps of a bouncing pair H~ drifts by no more than as many roundings do",
                       "[pair_potential][long]", ((int Dim), Dim), 2, 3) {
    constexpr int steps = 1'000'000;
    BouncingPair<Dim> pair(GENERATE(0.02, 0.05));
    const double start = pair.pseudo_energy();
    double drift = 0.0;
    for (int i = 0; i < steps; ++i) {
        pair.step();
        if (i % 100 == 99) raise(drift, std::abs(pair.pseudo_energy() - start));
    }
    CHECK(pair.bounces() > 1000);
    // each to one side or the other: a random walk
    CHECK(drift < std::sqrt(static_cast<double>(steps)) * std::numeric_limits<double>::epsilon() * start);
}
