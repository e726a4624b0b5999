#pragma once
// Private to the layer; see lanes.hpp.

namespace abut::geometry::lanes {

/// How a step is integrated (PairPathOptions).
enum class Integral {
    checked,  ///< mean of both ends, then Simpson's rule, then pieces, until the correction is small
    pieces,   ///< Gauss's rule over pieces between events
    whole,    ///< Gauss's rule over the step as a whole
    ends,     ///< mean of both ends alone
    end,      ///< no mean: the gradient at the end
};

/// Numbers of a PairEnd: W, the least gap, the area, n_1 . n_2, then n, the gradient and the pressures.
template <int Dim>
inline constexpr int end_size = 4 + Dim + 2 * Dim*(Dim + 1);

/// A pair along one step, as numbers alone.
template <int Dim>
struct LaneTask {
    // given
    const double* x_0;  // (2 Dim, Dim)
    const double* x_1;
    const double* start;  // PairEnd at x_0; null: not known
    double stiffness;
    double length[2];
    double full, none;
    double offset;
    // found
    double* end;       // PairEnd at x_1
    double* gradient;  // (2 Dim, Dim)
    double* pressure;  // (2 Dim)
    double* normal;    // (Dim)
    double facing;
    double energy_0, energy_1;
    double gap_0, gap_1;
    double area;
    double active_share;
    double correction;
    int cuts;  // of the step
};

/// Tasks that one call takes at most.
inline constexpr int most_tasks = 64;

// The same for different processors: numbers of lanes.
void integrate_by_2(LaneTask<2>* tasks, int n, Integral integral);
void integrate_by_2(LaneTask<3>* tasks, int n, Integral integral);
void integrate_by_4(LaneTask<2>* tasks, int n, Integral integral);
void integrate_by_4(LaneTask<3>* tasks, int n, Integral integral);
void integrate_by_8(LaneTask<2>* tasks, int n, Integral integral);
void integrate_by_8(LaneTask<3>* tasks, int n, Integral integral);

}  // namespace abut::geometry::lanes
