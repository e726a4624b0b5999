#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_group.hpp"

namespace abut::geometry::lanes {

inline constexpr int most_pieces = 9;

/// Ends of the pieces of a step, ascending from 0 to 1.
struct LaneCuts {
    double at[most_pieces + 1];
    int pieces;
};
/// 0 <= s <= 1; anything else cuts nothing, nor does one cut too many.
template <int Dim>
static void insert(double s, LaneCuts& cuts) {
    if (!(s >= 0.0 && s <= 1.0) || cuts.pieces == most_pieces) return;
    int i = ++cuts.pieces;
    for (; cuts.at[i - 1] > s; --i) cuts.at[i] = cuts.at[i - 1];
    cuts.at[i] = s;
}
/// Cuts where the straight line from a to b crosses 0.
template <int Dim>
static void cut_at_root(double a, double b, LaneCuts& cuts) {
    if ((a < 0.0) != (b < 0.0)) insert<Dim>(a / (a - b), cuts);
}

inline constexpr int n_events = 8;

/// Distance of the corners of each face from the line of the other, times its length, and of ends along the pair.
template <class T>
void event_functions(const LaneCorners<T, 2>& z, T* values) {
    const int ends[4][2] = {{0, 3}, {1, 2}, {0, 2}, {1, 3}};
    for (int i = 0; i < 4; ++i) values[i] = z.at[ends[i][0]].c[0] - z.at[ends[i][1]].c[0];
    for (int corner = 0; corner < 4; ++corner) {
        const LaneVector<T, 2>& start = z.at[corner < 2 ? 2 : 0];
        values[4 + corner] = cross(z.at[corner < 2 ? 3 : 1] - start, z.at[corner] - start);
    }
}

/// Events of a step in 2D, as straight lines between both ends: their roots need not be exact, since the correction takes
/// up what is left.
template <class T, int Dim>
struct LaneEvents {
    explicit LaneEvents(const LaneStep<T, 2>& step, const FlagsOf<T>&) {
        event_functions(step.start.z, at_0);
        event_functions(step.at(T(1.0)), at_1);
    }
    [[nodiscard]] FlagsOf<T> cut() const {
        FlagsOf<T> some = (at_0[0] < T(0.0)) ^ (at_1[0] < T(0.0));
        for (int i = 1; i < n_events; ++i) some = some | ((at_0[i] < T(0.0)) ^ (at_1[i] < T(0.0)));
        return some;
    }
    void insert_into(LaneCuts& cuts, const LaneTask<2>&) const {
        for (int i = 0; i < n_events; ++i) cut_at_root<2>(lane(at_0[i], 0), lane(at_1[i], 0), cuts);
    }

    T at_0[n_events], at_1[n_events];
};

/// In 3D, where the contact begins or ends, by the least gap over the overlap. Other events are no roots of short
/// polynomials: long paths are halved instead.
template <class T>
struct LaneEvents<T, 3> {
    LaneEvents(const LaneStep<T, 3>& of_step, const FlagsOf<T>& begins_or_ends)
        : step(of_step), touches(begins_or_ends), is_long(of_step.is_long()) {}
    [[nodiscard]] FlagsOf<T> cut() const { return touches | is_long; }
    void insert_into(LaneCuts& cuts, const LaneTask<3>& task) const {
        if (lane(touches, 0)) {
            const bool begins = task.energy_0 == 0.0;
            const LaneEnergy<T, 3> apart = energy_of(begins ? step.start.z : step.at(T(1.0)), step.law);
            const double view_gap = lane(apart.view_gap, 0);
            if (lane(apart.facing < step.law.none, 0) && lane(apart.overlap, 0) > 0.0)
                cut_at_root<3>(begins ? view_gap : task.gap_0, begins ? task.gap_1 : view_gap, cuts);
        }
        if (lane(is_long, 0)) insert<3>(0.5, cuts);
    }

    const LaneStep<T, 3>& step;
    FlagsOf<T> touches, is_long;
};

inline constexpr double gauss_2[2] = {0.21132486540518711775, 0.78867513459481288225};
inline constexpr double gauss_3[3] = {0.11270166537925831148, 0.5, 0.88729833462074168852};
inline constexpr double weight_3[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// States along a step, and their weights in the mean.
struct LanePoints {
    double at[3 * most_pieces];
    double weight[3 * most_pieces];
    int n;
};
/// Gauss's rule on each piece. Faces that only translate have a force of degree 3 between events, in 2D and in 3D.
template <int Dim>
static void gauss_points(const LaneCuts& cuts, bool two_are_exact, LanePoints& points) {
    points.n = 0;
    for (int piece = 0; piece < cuts.pieces; ++piece) {
        const double begin = cuts.at[piece], length = cuts.at[piece + 1] - begin;
        if (length == 0.0) continue;
        for (int k = 0; k < (two_are_exact ? 2 : 3); ++k, ++points.n) {
            points.at[points.n] = begin + (two_are_exact ? gauss_2[k] : gauss_3[k]) * length;
            points.weight[points.n] = (two_are_exact ? 0.5 : weight_3[k]) * length;
        }
    }
}

/// Adds state i of some lanes to the mean of one pair, whose lanes are all alike.
template <class T, int Dim>
void add(const LaneEnergy<T, Dim>& state, int i, double weight, LaneMean<T, Dim>& mean) {
    const auto add_to = [&](T& total, const T& value) { total = total + T(weight * lane(value, i)); };
    for (int v = 0; v < 2 * Dim; ++v) {
        for (int d = 0; d < Dim; ++d) add_to(mean.gradient.at[v].c[d], state.gradient.at[v].c[d]);
        add_to(mean.pressure[v], state.pressure[v]);
    }
    add_to(mean.area, state.area);
    if (lane(state.energy, i) > 0.0) mean.active_share = mean.active_share + T(weight);
}

/// One pair by pieces; the lanes are states of it.
template <class T, int Dim>
void integrate_pieces(LaneTask<Dim>& task) {
    const int only = 0;
    const LaneGroup<T, Dim> group(&task, &only, 1);
    const LaneStep<T, Dim> step = group.step();
    LaneCuts cuts{{0.0, 1.0}, 1};
    LaneEvents<T, Dim>(step, group.begins_or_ends()).insert_into(cuts, task);
    LanePoints points;
    gauss_points<Dim>(cuts, Dim == 2 || lane(step.only_translates(), 0), points);
    LaneMean<T, Dim> mean = weighed<T, Dim>(nullptr, nullptr, 0);
    mean.energy_0 = T(task.energy_0);
    mean.energy_1 = T(task.energy_1);
    mean.depth = T(task.gap_0 < task.gap_1 ? -task.gap_0 : -task.gap_1);
    constexpr int count = LanesOf<T>::count;
    for (int first = 0; first < points.n; first += count) {
        const int used = points.n - first < count ? points.n - first : count;
        T s;
        for (int i = 0; i < count; ++i) set_lane(s, i, points.at[first + (i < used ? i : 0)]);
        const LaneEnergy<T, Dim> states = energy_of(step.at(s), step.law);
        for (int i = 0; i < used; ++i) add(states, i, points.weight[first + i], mean);
    }
    group.write(mean, closed(step, mean), 0, cuts.pieces - 1, task);
}

/// Gauss's rule, of these tasks; those that have events are cut there, if they are to be.
template <class T, int Dim>
void integrate_by_gauss(LaneTask<Dim>* tasks, const int* which, int n, bool at_events) {
    for_each_group<T>(tasks, which, n, [&](const LaneGroup<T, Dim>& group, int) {
        const LaneStep<T, Dim> step = group.step();
        const FlagsOf<T> is_cut = LaneEvents<T, Dim>(step, group.begins_or_ends()).cut();
        const FlagsOf<T> by_two = step.only_translates();
        LaneEnergy<T, Dim> states[3];
        T weights[3];
        const int points = Dim == 2 ? 2 : 3;
        for (int k = 0; k < points; ++k) {
            const double at_2 = k < 2 ? gauss_2[k] : 0.5;
            const T at = Dim == 2 ? T(at_2) : select(by_two, T(at_2), T(gauss_3[k]));
            weights[k] = Dim == 2 ? T(0.5) : select(by_two, T(k < 2 ? 0.5 : 0.0), T(weight_3[k]));
            states[k] = energy_of(step.at(at), step.law);
        }
        const LaneEnergy<T, Dim>* const all[3] = {&states[0], &states[1], &states[2]};
        LaneMean<T, Dim> mean = weighed(all, weights, points);
        mean.energy_0 = group.read(&LaneTask<Dim>::energy_0);
        mean.energy_1 = group.read(&LaneTask<Dim>::energy_1);
        mean.depth = -lower(group.read(&LaneTask<Dim>::gap_0), group.read(&LaneTask<Dim>::gap_1));
        const LaneClosed<T, Dim> result = closed(step, mean);
        for (int i = 0; i < group.n; ++i) {
            if (at_events && lane(is_cut, i))
                integrate_pieces<T>(*group.task[i]);
            else
                group.write(mean, result, i, 0, *group.task[i]);
        }
    });
}

}  // namespace abut::geometry::lanes
