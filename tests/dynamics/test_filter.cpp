// The filter takes any system of points that says what was in contact.
#include "abut/dynamics/filter.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "dynamics/row.hpp"

using namespace abut;
using dynamics::MomentArms;
using test::Conserved;
using test::NodeState;
using test::Row;
using test::square_of_e;

namespace {

const std::vector<double> masses{1.0, 2.0, 0.5, 1.5, 0.7, 1.1, 0.9};

/// By how much two states of the same node differ, in M^-1.
template <int Dim>
double distance(const Row<Dim>& row, const NodeState& a, const NodeState& b) {
    double sum = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j)
        sum += row.inverse_mass()[j] * (a.after[j] - b.after[j]) * (a.after[j] - b.after[j]);
    return std::sqrt(sum);
}

template <int Dim>
NodeState filtered(Row<Dim>& row, NodeState state, double kappa = 1.0) {
    dynamics::NeutralFilter filter(row, kappa);
    filter(state.q, state.dt, state.before, state.after);
    return state;
}

/// What stops all motion along the axes from `first` on.
template <int Dim>
std::vector<dynamics::Hold<Dim>> frame(int first) {
    std::vector<dynamics::Hold<Dim>> holds;
    for (int place = 0; place <= Dim; ++place)
        for (int d = first; d < Dim; ++d)
            holds.push_back({place < Dim ? Vector<Dim>::Unit(place) : Vector<Dim>::Zero(), Vector<Dim>::Unit(d)});
    return holds;
}

/// A rotation that takes the rigid motion about q^{n+1} out of e and v in place of that about the middle of the step.
NodeState filtered_about_the_end(Row<2>& row, NodeState state) {
    const auto n = static_cast<Eigen::Index>(row.size());
    Eigen::MatrixXd rigid(n, 4);  // momenta over the root of the mass, v last
    Eigen::VectorXd e(n);
    std::vector<double> force(row.size());
    row.force(state.q, force);
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double root = 1.0 / std::sqrt(row.inverse_mass()[i]);
        const auto point = i / 2, other = i ^ 1;
        const double arm = row.rest_positions()[point][(j + 1) % 2] + state.q[other];
        rigid.row(j) << root * (j % 2 == 0), root * (j % 2), root * (j % 2 == 0 ? -arm : arm), state.before[i] / root;
        e[j] = (state.after[i] - state.before[i] - state.dt * force[i]) / root;
    }
    const Eigen::VectorXd projection = rigid * (rigid.transpose() * rigid).ldlt().solve(rigid.transpose() * e);
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto i = static_cast<std::size_t>(j);
        state.after[i] -= (e[j] - projection[j]) / std::sqrt(row.inverse_mass()[i]);
    }
    return state;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the filter changes neither H~ nor momentum nor the angular momentum that the system conserves",
                       "[dynamics][filter]", ((int Dim), Dim), 1, 2, 3) {
    std::mt19937 random(11);
    Row<Dim> row(masses, 3.0);
    row.arms = GENERATE(MomentArms::rest, MomentArms::mid_step);
    const std::vector<std::int32_t> points =
        GENERATE(std::vector<std::int32_t>{1, 2, 3, 5}, std::vector<std::int32_t>{0, 4, 6}, std::vector<std::int32_t>{2, 3});
    row.patches = {{.points = points, .holds = {}}};
    bool has_taken = false;
    for (int trial = 0; trial < 20; ++trial) {
        const NodeState given = test::random_state(random, row.size(), 0.3);
        const NodeState after = filtered(row, given);
        const Conserved<Dim> a(row, given, points), b(row, after, points);
        CHECK(std::abs(b.kinetic - a.kinetic) < 1e-14);
        CHECK((b.momentum - a.momentum).norm() < 1e-14);
        if (row.arms == MomentArms::rest) CHECK((b.rest - a.rest).norm() < 3e-14);
        if (row.arms == MomentArms::mid_step) CHECK((b.pseudo - a.pseudo).norm() < 3e-14);
        CHECK(square_of_e(row, after) <= square_of_e(row, given));
        has_taken = has_taken || distance(row, given, after) > 0.1;
        for (std::size_t i = 0; i < row.size(); ++i)
            if (std::ranges::find(points, static_cast<std::int32_t>(i / Dim)) == points.end())
                CHECK(after.after[i] == given.after[i]);
    }
    // In the plane four vectors are kept, in space seven, and points on a line at rest cannot turn about it.
    const int kept = Dim + Dim * (Dim - 1) / 2 + 1 - (Dim == 3 && row.arms == MomentArms::rest ? 1 : 0);
    CHECK(has_taken == (Dim * static_cast<int>(points.size()) > kept));
}

TEMPLATE_TEST_CASE_SIG("each choice of the moments keeps one angular momentum and moves the other", "[dynamics][filter]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(5);
    Row<Dim> row(masses, 3.0);
    const std::vector<std::int32_t> points{0, 1, 2, 3, 4, 5, 6};
    row.patches = {{.points = points, .holds = {}}};
    const NodeState given = test::random_state(random, row.size(), 0.3);
    const Conserved<Dim> before(row, given, points);
    for (const MomentArms arms : {MomentArms::rest, MomentArms::mid_step}) {
        row.arms = arms;
        const Conserved<Dim> after(row, filtered(row, given), points);
        CHECK((((after.rest - before.rest).norm() < 1e-13)) == (arms == MomentArms::rest));
        CHECK((((after.pseudo - before.pseudo).norm() < 1e-13)) == (arms == MomentArms::mid_step));
    }
}

TEST_CASE("rotations about the end of the step, which look right, move J~", "[dynamics][filter]") {
    std::mt19937 random(7);
    Row<2> row(masses, 3.0);
    row.arms = MomentArms::mid_step;
    std::vector<std::int32_t> points(masses.size());
    std::iota(points.begin(), points.end(), 0);
    row.patches = {{.points = points, .holds = {}}};
    const NodeState given = test::random_state(random, row.size(), 0.01);
    const Conserved<2> before(row, given, points), about_end(row, filtered_about_the_end(row, given), points);
    CHECK(std::abs(about_end.kinetic - before.kinetic) < 1e-14);
    CHECK((about_end.moved - before.moved).norm() < 1e-13);
    CHECK((about_end.pseudo - before.pseudo).norm() > 1e-9);
    const Conserved<2> about_middle(row, filtered(row, given), points);
    CHECK((about_middle.pseudo - before.pseudo).norm() < 1e-13);
}

TEMPLATE_TEST_CASE_SIG("where something holds a patch, only the momentum of the rigid motions that it allows stays",
                       "[dynamics][filter]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(13);
    Row<Dim> row(masses, 3.0);
    row.arms = GENERATE(MomentArms::rest, MomentArms::mid_step);
    const int first_held =
        GENERATE(0, Dim - 1);  // a frame that stops all; rollers, which stop what moves along the last axis
    const std::vector<std::int32_t> points{1, 2, 3, 5};
    row.patches = {{.points = points, .holds = frame<Dim>(first_held)}};
    const NodeState given = test::random_state(random, row.size(), 0.01);
    const NodeState after = filtered(row, given);
    const Conserved<Dim> a(row, given, points), b(row, after, points);
    CHECK(std::abs(b.kinetic - a.kinetic) < 1e-14);
    for (int d = 0; d < Dim; ++d) CHECK((std::abs(b.momentum[d] - a.momentum[d]) < 1e-14) == (d < first_held));
    if (Dim == 3 && first_held == 2) {  // they turn about the normal of the rollers
        const auto change = row.arms == MomentArms::rest ? b.rest - a.rest : b.pseudo - a.pseudo;
        CHECK(std::abs(change[Dim == 3 ? 2 : 0]) < 1e-13);
    }
    CHECK(square_of_e(row, after) < square_of_e(row, given));
}

TEST_CASE("H~ stays to round-off however near to a rigid motion a patch moves", "[dynamics][filter]") {
    std::mt19937 random(17);
    Row<2> row(masses, 3.0);
    const std::vector<std::int32_t> points{0, 1, 2, 3, 4, 5, 6};
    row.patches = {{.points = points, .holds = {}}};
    const double beside = GENERATE(0.0, 1e-15, 1e-13, 1e-11, 1e-8);  // of the velocity is not rigid
    NodeState given = test::random_state(random, row.size(), 0.01);
    const std::vector<double> noise = test::random_values(random, row.size());
    for (std::size_t j = 0; j < row.size(); ++j)
        given.before[j] = (static_cast<double>(j % 2) + 0.4 + beside * noise[j]) / row.inverse_mass()[j];
    const Conserved<2> a(row, given, points), b(row, filtered(row, given), points);
    CHECK(std::abs(b.kinetic - a.kinetic) < 1e-14 * 10.0);
}

TEST_CASE("the filter refuses a part of the mode that is not from 0 to 1", "[dynamics][filter][errors]") {
    Row<2> row({1.0, 2.0}, 3.0);
    const auto make = [&](double kappa) { dynamics::NeutralFilter(row, kappa); };
    for (const double kappa : {0.0, 0.5, 1.0}) CHECK_NOTHROW(make(kappa));
    for (const double kappa : {-1e-9, 1.0 + 1e-9, std::nan("")}) {
        CAPTURE(kappa);
        CHECK_THROWS_WITH(make(kappa), Catch::Matchers::Contains("kappa") && Catch::Matchers::Contains("0 to 1"));
    }
}
