#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_gauss.hpp"

namespace abut::geometry::lanes {

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
