#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_energy_2d.hpp"
#include "abut/geometry/pair_potential/lanes/lane_energy_3d.hpp"
#include "abut/geometry/pair_potential/lanes/lane_task.hpp"

namespace abut::geometry::lanes {

inline constexpr double eps = 2.220446049250313e-16;

/// Part of the gradient up to which a correction is small: what Integral::checked asks for.
inline constexpr double small_correction = 1e-7;

/// Sum of the products of all components.
template <class T, int Dim>
T dot(const LaneCorners<T, Dim>& a, const LaneCorners<T, Dim>& b) {
    T sum = dot(a.at[0], b.at[0]);
    for (int v = 1; v < 2 * Dim; ++v) sum = sum + dot(a.at[v], b.at[v]);
    return sum;
}
template <class T, int Dim>
LaneCorners<T, Dim> difference(const LaneCorners<T, Dim>& a, const LaneCorners<T, Dim>& b) {
    LaneCorners<T, Dim> result;
    for (int v = 0; v < 2 * Dim; ++v) result.at[v] = a.at[v] - b.at[v];
    return result;
}
template <class T, int Dim>
LaneCorners<T, Dim> sum(const LaneCorners<T, Dim>& a, const T& factor, const LaneCorners<T, Dim>& b) {
    LaneCorners<T, Dim> result;
    for (int v = 0; v < 2 * Dim; ++v) result.at[v] = a.at[v] + factor * b.at[v];
    return result;
}

/// The largest length of a corner.
template <class T, int Dim>
T largest_corner(const LaneCorners<T, Dim>& z) {
    T largest = dot(z.at[0], z.at[0]);
    for (int v = 1; v < 2 * Dim; ++v) largest = higher(largest, dot(z.at[v], z.at[v]));
    return square_root(largest);
}

/// A pair in each lane, along its step.
template <class T, int Dim>
struct LaneStep {
    LaneStep(const LaneCorners<T, Dim>& start_at, const LaneCorners<T, Dim>& end_at, const LaneLaw<T>& of_pair)
        : law(of_pair),
          x_motion(difference(end_at, start_at)),
          start(start_at, of_pair),
          end(end_at, of_pair),
          motion(difference(end.z, start.z)) {}

    [[nodiscard]] LaneCorners<T, Dim> at(const T& s) const { return sum(start.z, s, motion); }
    [[nodiscard]] T size() const { return higher(largest_corner(start.z), largest_corner(end.z)); }
    /// True if corners move by much of the size of the pair.
    [[nodiscard]] FlagsOf<T> is_long() const { return largest_corner(motion) > T(0.03) * size(); }
    /// True if no face turns or changes its shape, beyond what rounding does to corners.
    [[nodiscard]] FlagsOf<T> only_translates() const {
        T change(0.0);
        for (int first = 0; first < 2 * Dim; first += Dim)
            for (int v = first + 1; v < first + Dim; ++v)
                for (int d = 0; d < Dim; ++d) change = higher(change, magnitude(motion.at[v].c[d] - motion.at[first].c[d]));
        return change <= T(8.0 * eps) * size();
    }

    LaneLaw<T> law;
    LaneCorners<T, Dim> x_motion;
    LaneFrame<T, Dim> start, end;
    LaneCorners<T, Dim> motion;  // Delta z
};

/// A state of a pair: W and its gradient, and n in space.
template <class T, int Dim>
struct LaneEnd : LaneEnergy<T, Dim> {
    LaneEnd() = default;
    LaneEnd(const LaneFrame<T, Dim>& frame, const LaneLaw<T>& law) : LaneEnergy<T, Dim>(energy_of(frame.z, law)) {
        normal = select<T, Dim>(this->facing < law.none, frame.in_space(this->common), no_vector<T, Dim>());
    }

    LaneVector<T, Dim> normal;  // 0 where the pair has no weight
};

/// A mean gradient in the coordinates of the pair, and what goes with it.
template <class T, int Dim>
struct LaneMean {
    T energy_0, energy_1;
    T depth;                       // the larger one of both ends
    LaneCorners<T, Dim> gradient;  // phi
    T pressure[2 * Dim];
    T area;
    T active_share;
};

/// The discrete gradient.
template <class T, int Dim>
struct LaneClosed {
    LaneCorners<T, Dim> gradient;
    T correction;
    FlagsOf<T> is_rough;  // the correction is not small, or a pair may pass another one between ends without energy
};

/// Takes a mean gradient back to space, and closes the balance of energy along the motion in the coordinates of the pair.
/// Nothing is added where the work is open by round-off of the energies or, in steps that are nothing but round-off, of the
/// force and of the overlap.
template <class T, int Dim>
LaneClosed<T, Dim> closed(const LaneStep<T, Dim>& step, const LaneMean<T, Dim>& mean) {
    LaneClosed<T, Dim> result;
    result.gradient = in_mean_frame(step.start, step.end, step.law, mean.gradient);
    const T open = (mean.energy_1 - mean.energy_0) - dot(result.gradient, step.x_motion);
    const T of_energies = T(8.0 * eps) * (mean.energy_0 + mean.energy_1);
    const T squared_motion = dot(step.motion, step.motion), distance = square_root(squared_motion);
    const T size = square_root(higher(dot(step.start.z, step.start.z), dot(step.end.z, step.end.z)));
    const T force = square_root(dot(mean.gradient, mean.gradient));
    T of_overlap = T(8.0 * eps) * step.law.stiffness * mean.depth * mean.depth;
    for (int d = 1; d < Dim; ++d) of_overlap = of_overlap * size;
    const FlagsOf<T> is_round_off =
        (magnitude(open) <= of_energies) |
        ((distance <= T(1e-9) * size) & (magnitude(open) <= of_energies + of_overlap + T(8.0 * eps) * force * size));
    const T factor = select(is_round_off, T(0.0), open) / select(is_round_off, T(1.0), squared_motion);
    result.gradient = sum(result.gradient, factor, in_mean_frame(step.start, step.end, step.law, step.motion));
    result.correction = magnitude(factor) * distance;
    const FlagsOf<T> has_energy = (mean.energy_0 > T(0.0)) | (mean.energy_1 > T(0.0));
    result.is_rough = (result.correction > T(small_correction) * force) | without(step.is_long(), has_energy);
    const FlagsOf<T> acts = (mean.active_share > T(0.0)) | has_energy;
    const FlagsOf<T> is_lost = turns_over<T>(step.start, step.end);
    for (int v = 0; v < 2 * Dim; ++v)
        for (int d = 0; d < Dim; ++d) {
            T& value = result.gradient.at[v].c[d];
            value = select(acts, select(is_lost, T(__builtin_nan("")), value), T(0.0));
        }
    result.correction = select(acts, result.correction, T(0.0));
    return result;
}

/// A rule with `n` states, weights[i] of energy i.
template <class T, int Dim>
LaneMean<T, Dim> weighed(const LaneEnergy<T, Dim>* const* states, const T* weights, int n) {
    LaneMean<T, Dim> mean;
    mean.area = mean.active_share = T(0.0);
    for (int v = 0; v < 2 * Dim; ++v) {
        mean.gradient.at[v] = no_vector<T, Dim>();
        mean.pressure[v] = T(0.0);
    }
    for (int i = 0; i < n; ++i) {
        const T& weight = weights[i];
        const LaneEnergy<T, Dim>& state = *states[i];
        mean.gradient = sum(mean.gradient, weight, state.gradient);
        for (int v = 0; v < 2 * Dim; ++v) mean.pressure[v] = mean.pressure[v] + weight * state.pressure[v];
        mean.area = mean.area + weight * state.area;
        mean.active_share = mean.active_share + select(state.energy > T(0.0), weight, T(0.0));
    }
    return mean;
}

// Between tasks and lanes

/// Lanes of T that belong to tasks: `which` of them, `n` <= LanesOf<T>::count; the other lanes repeat the first.
template <class T, int Dim>
struct LaneGroup {
    static constexpr int count = LanesOf<T>::count;

    LaneGroup(LaneTask<Dim>* all, const int* which, int used) : n(used) {
        for (int i = 0; i < count; ++i) task[i] = &all[which[i < used ? i : 0]];
    }
    [[nodiscard]] LaneCorners<T, Dim> corners(const double* LaneTask<Dim>::*of) const {
        LaneCorners<T, Dim> x;
        for (int v = 0; v < 2 * Dim; ++v)
            for (int d = 0; d < Dim; ++d)
                for (int i = 0; i < count; ++i) set_lane(x.at[v].c[d], i, (task[i]->*of)[v * Dim + d]);
        return x;
    }
    [[nodiscard]] LaneLaw<T> law() const {
        LaneLaw<T> law;
        for (int i = 0; i < count; ++i) {
            set_lane(law.stiffness, i, task[i]->stiffness);
            set_lane(law.length[0], i, task[i]->length[0]);
            set_lane(law.length[1], i, task[i]->length[1]);
            set_lane(law.full, i, task[i]->full);
            set_lane(law.none, i, task[i]->none);
            set_lane(law.offset, i, task[i]->offset);
        }
        return law;
    }
    [[nodiscard]] LaneStep<T, Dim> step() const {
        return {corners(&LaneTask<Dim>::x_0), corners(&LaneTask<Dim>::x_1), law()};
    }
    [[nodiscard]] T read(const double LaneTask<Dim>::*of) const {
        T values;
        for (int i = 0; i < count; ++i) set_lane(values, i, task[i]->*of);
        return values;
    }
    /// Whether all tasks are those of states: both ends are one.
    [[nodiscard]] bool is_at_rest() const {
        for (int i = 0; i < n; ++i)
            if (task[i]->x_0 != task[i]->x_1) return false;
        return true;
    }
    /// Whether W is 0 at one end alone, whose energies are known.
    [[nodiscard]] FlagsOf<T> begins_or_ends() const {
        const T energy_0 = read(&LaneTask<Dim>::energy_0), energy_1 = read(&LaneTask<Dim>::energy_1);
        return (energy_0 > T(0.0)) ^ (energy_1 > T(0.0));
    }
    /// The numbers of a PairEnd in each lane.
    [[nodiscard]] LaneEnd<T, Dim> read(const double* const* from) const {
        LaneEnd<T, Dim> of;
        for (int i = 0; i < count; ++i) {
            const double* end = from[i];
            set_lane(of.energy, i, end[0]);
            set_lane(of.gap, i, end[1]);
            set_lane(of.area, i, end[2]);
            set_lane(of.facing, i, end[3]);
            const double* next = end + 4;
            for (int d = 0; d < Dim; ++d) set_lane(of.normal.c[d], i, *next++);
            for (int v = 0; v < 2 * Dim; ++v)
                for (int d = 0; d < Dim; ++d) set_lane(of.gradient.at[v].c[d], i, *next++);
            for (int v = 0; v < 2 * Dim; ++v) set_lane(of.pressure[v], i, *next++);
        }
        return of;
    }
    static void write(const LaneEnd<T, Dim>& of, int i, double* end) {
        end[0] = lane(of.energy, i);
        end[1] = lane(of.gap, i);
        end[2] = lane(of.area, i);
        end[3] = lane(of.facing, i);
        double* next = end + 4;
        for (int d = 0; d < Dim; ++d) *next++ = lane(of.normal.c[d], i);
        for (int v = 0; v < 2 * Dim; ++v)
            for (int d = 0; d < Dim; ++d) *next++ = lane(of.gradient.at[v].c[d], i);
        for (int v = 0; v < 2 * Dim; ++v) *next++ = lane(of.pressure[v], i);
    }
    /// Writes what a step makes of lane `i`, beside the energies and gaps of its ends.
    static void write(const LaneMean<T, Dim>& mean, const LaneClosed<T, Dim>& of, int i, int cuts, LaneTask<Dim>& task) {
        for (int v = 0; v < 2 * Dim; ++v)
            for (int d = 0; d < Dim; ++d) task.gradient[v * Dim + d] = lane(of.gradient.at[v].c[d], i);
        for (int v = 0; v < 2 * Dim; ++v) task.pressure[v] = lane(mean.pressure[v], i);
        task.area = lane(mean.area, i);
        task.active_share = lane(mean.active_share, i);
        task.correction = lane(of.correction, i);
        task.cuts = cuts;
    }

    LaneTask<Dim>* task[count];
    int n;
};

/// Calls body(group) for groups of these tasks.
template <class T, int Dim, class Body>
void for_each_group(LaneTask<Dim>* tasks, const int* which, int n, const Body& body) {
    constexpr int count = LanesOf<T>::count;
    for (int first = 0; first < n; first += count)
        body(LaneGroup<T, Dim>(tasks, which + first, n - first < count ? n - first : count), first);
}

// Pieces of a step

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

/// Sets `end`, the energies and gaps of both ends, and the mean of both, of each of these tasks; returns how many of them
/// are rough, which are listed in `rough`. `starts`: of tasks that do not know it.
template <class T, int Dim>
int integrate_ends(LaneTask<Dim>* tasks, int n, Integral integral, double (*starts)[end_size<Dim>], int* rough) {
    int which[most_tasks], unknown[most_tasks], n_unknown = 0, n_rough = 0;
    for (int i = 0; i < n; ++i) {
        which[i] = i;
        if (tasks[i].start == nullptr) unknown[n_unknown++] = i;
    }
    for_each_group<T>(tasks, unknown, n_unknown, [&](const LaneGroup<T, Dim>& group, int first) {
        const LaneLaw<T> law = group.law();
        const LaneEnd<T, Dim> start(LaneFrame<T, Dim>(group.corners(&LaneTask<Dim>::x_0), law), law);
        for (int i = 0; i < group.n; ++i) group.write(start, i, starts[unknown[first + i]]);
    });
    for_each_group<T>(tasks, which, n, [&](const LaneGroup<T, Dim>& group, int first) {
        const double* from[LanesOf<T>::count];
        for (int i = 0; i < LanesOf<T>::count; ++i)
            from[i] = group.task[i]->start != nullptr ? group.task[i]->start : starts[first + (i < group.n ? i : 0)];
        const LaneStep<T, Dim> step = group.step();
        const LaneEnd<T, Dim> start = group.read(from);
        const LaneEnd<T, Dim> end = group.is_at_rest() ? start : LaneEnd<T, Dim>(step.end, step.law);
        const LaneEnergy<T, Dim>* const ends[2] = {&start, &end};
        const T halves[2] = {T(0.5), T(0.5)}, second[2] = {T(0.0), T(1.0)};
        LaneMean<T, Dim> mean = weighed(ends, integral == Integral::end ? second : halves, 2);
        mean.energy_0 = start.energy;
        mean.energy_1 = end.energy;
        mean.depth = -lower(start.gap, end.gap);
        const LaneVector<T, Dim> normal = start.normal + end.normal;
        const T facing = higher(start.facing, end.facing);
        LaneClosed<T, Dim> result;
        if (integral == Integral::end) {
            result.gradient = in_mean_frame(step.end, step.end, step.law, end.gradient);
            result.correction = T(0.0);
        } else {
            result = closed(step, mean);
        }
        for (int i = 0; i < group.n; ++i) {
            LaneTask<Dim>& task = *group.task[i];
            group.write(end, i, task.end);
            task.energy_0 = lane(start.energy, i);
            task.energy_1 = lane(end.energy, i);
            task.gap_0 = lane(start.gap, i);
            task.gap_1 = lane(end.gap, i);
            for (int d = 0; d < Dim; ++d) task.normal[d] = lane(normal.c[d], i);
            task.facing = lane(facing, i);
            group.write(mean, result, i, 0, task);
            const bool is_done = integral == Integral::ends || integral == Integral::end ||
                                 (integral == Integral::checked && !lane(result.is_rough, i));
            if (!is_done) rough[n_rough++] = first + i;
        }
    });
    return n_rough;
}

/// Simpson's rule, of these tasks; returns how many of them stay rough, and moves these to the front.
template <class T, int Dim>
int integrate_with_middle(LaneTask<Dim>* tasks, int* which, int n, double (*starts)[end_size<Dim>]) {
    int n_rough = 0;
    for_each_group<T>(tasks, which, n, [&](const LaneGroup<T, Dim>& group, int first) {
        const double *from_0[LanesOf<T>::count], *from_1[LanesOf<T>::count];
        for (int i = 0; i < LanesOf<T>::count; ++i) {
            const LaneTask<Dim>& task = *group.task[i];
            from_0[i] = task.start != nullptr ? task.start : starts[which[first + (i < group.n ? i : 0)]];
            from_1[i] = task.end;
        }
        const LaneStep<T, Dim> step = group.step();
        const LaneEnd<T, Dim> start = group.read(from_0), end = group.read(from_1);
        const LaneEnergy<T, Dim> middle = energy_of(step.at(T(0.5)), step.law);
        const LaneEnergy<T, Dim>* const states[3] = {&start, &middle, &end};
        const T weights[3] = {T(1.0 / 6.0), T(4.0 / 6.0), T(1.0 / 6.0)};
        LaneMean<T, Dim> mean = weighed(states, weights, 3);
        mean.energy_0 = start.energy;
        mean.energy_1 = end.energy;
        mean.depth = -lower(start.gap, end.gap);
        const LaneClosed<T, Dim> result = closed(step, mean);
        for (int i = 0; i < group.n; ++i) {
            group.write(mean, result, i, 0, *group.task[i]);
            if (lane(result.is_rough, i)) which[n_rough++] = which[first + i];
        }
    });
    return n_rough;
}

template <class T, int Dim>
void integrate(LaneTask<Dim>* tasks, int n, Integral integral) {
    double starts[most_tasks][end_size<Dim>];
    int rough[most_tasks];
    int n_rough = integrate_ends<T>(tasks, n, integral, starts, rough);
    if (integral == Integral::checked) n_rough = integrate_with_middle<T>(tasks, rough, n_rough, starts);
    integrate_by_gauss<T>(tasks, rough, n_rough, integral != Integral::whole);
}

}  // namespace abut::geometry::lanes
