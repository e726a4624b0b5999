#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_step.hpp"
#include "abut/geometry/pair_potential/lanes/lane_task.hpp"

namespace abut::geometry::lanes {

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

}  // namespace abut::geometry::lanes
