#pragma once
#include <array>
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Corners of the two faces of a pair [m]: Dim of face 1, then Dim of face 2. Segments (2D) with the outside on the right of
/// the line from the first to the second corner; triangles (3D), counter-clockwise seen from outside. No face may have
/// measure 0.
template <int Dim>
using PairCorners = std::array<Vector<Dim>, 2 * Dim>;

/// Normal force of a pair by corner, chi int k |g| N_v dA with the linear shape function N_v of a corner on its face
/// [N], >= 0. The corners of one face together have the whole normal force, and so have those of the other; the point
/// of face i at which the pair presses is the mean of its corners with these weights.
template <int Dim>
using PairPressure = std::array<double, 2 * Dim>;

/// The weight chi of a pair as its faces turn away from each other: 1 up to n_1 . n_2 = `full`, 0 from `none` on, smooth in
/// between. -1 <= full < none <= 0.
struct FacingFade {
    double full = -0.6;
    double none = -0.2;
};

/// The contact potential of a pair of faces whose corners move,
///
///     W = chi(n_1 . n_2) k/2 int_P min(g, 0)^2 dA,
///
/// over the overlap P of the faces, seen along n = (n_1 - n_2)/|n_1 - n_2|; g is the height of face 2 over face 1 along
/// n, and `offset` more. W does not change when the pair moves or turns as a whole. docs/method.md, The potential of a
/// pair.
template <int Dim>
struct PairLaw {
    double stiffness;                    ///< k [Pa/m]
    std::array<double, 2> length{1, 1};  ///< of the two segments at rest [m]; they weigh the normals in n (2D alone)
    FacingFade facing{};
    double offset = 0.0;  ///< [m] >= 0
};

/// State of a pair in one position.
template <int Dim>
struct PairState {
    double energy = 0.0;                       ///< W [J]
    double facing = 1.0;                       ///< n_1 . n_2
    double overlap = 0.0;                      ///< |P| [m^(Dim-1)]
    double area = 0.0;                         ///< that of the part of P where g < 0
    double gap = 0.0;                          ///< the least g over P [m]; see `pair_state` where P is empty
    Vector<Dim> normal = Vector<Dim>::Zero();  ///< n, from face 1 to face 2
};

/// `gap` of faces that share nothing is g halfway between the nearest points of the faces seen along n. Faces that look the
/// same way (n_1 . n_2 > 0.3) have no n: the gap is then infinite.
template <int Dim>
[[nodiscard]] PairState<Dim> pair_state(const PairCorners<Dim>& corners, const PairLaw<Dim>& law);

/// Classes of pairs that can be told apart at little cost.
enum class PairPlace {
    apart,        ///< g >= 0 all over: W = 0
    beside,       ///< no overlap: W = 0
    turned_away,  ///< n_1 . n_2 >= FacingFade::none: W = 0
    unclear,      ///< none of these is sure
};
template <int Dim>
struct PairPlacement {
    PairPlace place;
    double facing;       ///< n_1 . n_2
    Vector<Dim> normal;  ///< n where the faces look at each other
    double above;        ///< from the highest corner of face 1 to the lowest one of face 2 along n [m]
    /// From the middle of face 1 to that of face 2, across n; asked for where they are not apart
    Vector<Dim> aside;
    double beside;  ///< as `above`, along `aside`, times its length
};
template <int Dim>
[[nodiscard]] PairPlacement<Dim> pair_placement(const PairCorners<Dim>& corners, const PairLaw<Dim>& law);
/// True if two placements tell that W = 0 all along the straight paths of the corners between them, which end at `end`.
template <int Dim>
[[nodiscard]] bool stays_inactive(const PairPlacement<Dim>& at_start, const PairPlacement<Dim>& at_end,
                                  const PairCorners<Dim>& end);

/// Possible states of a pair in all positions in which no corner is farther than a reach from where it is now.
template <int Dim>
struct PairOutlook {
    /// False only if W = 0 in all of them, where |g| is not larger than a given depth: the faces stay apart, above or beside
    /// each other, or cannot come to look at each other.
    bool may_act = true;
    bool is_apart = false;                     ///< g > 0 all over as it is now; told where it may not act
    Vector<Dim> normal = Vector<Dim>::Zero();  ///< n as it is now, unit; zero: n can turn too far for `rests`
    Vector<Dim> aside = Vector<Dim>::Zero();   ///< from face 1 to face 2 across n, unit
    double aside_allowance = 0.0;              ///< what apart along `aside` must exceed, since n turns [m]
};
template <int Dim>
[[nodiscard]] PairOutlook<Dim> pair_outlook(const PairCorners<Dim>& corners, const PairLaw<Dim>& law, double reach,
                                            double depth);

enum class PairRest {
    no,      ///< or not sure
    apart,   ///< g >= 0 all over: W = 0
    beside,  ///< no overlap, where |g| <= depth: W = 0
};
/// Conclusion from an outlook for one of these positions; the cheapest of all tests.
template <int Dim>
[[nodiscard]] PairRest rests(const PairOutlook<Dim>& outlook, const PairCorners<Dim>& corners);

template <int Dim>
struct PairGradient {
    double energy = 0.0;          ///< W [J]
    double gap = 0.0;             ///< least g of the overlap, 0 where W = 0 [m]
    PairCorners<Dim> gradient{};  ///< dW/dx of each corner [N]; zero where W is
    double area = 0.0;            ///< of the part of the overlap where g < 0 [m^(Dim-1)]
    PairPressure<Dim> pressure{};
};

/// W and dW/dx. The sum of the gradients and of their moments is zero.
template <int Dim>
[[nodiscard]] PairGradient<Dim> pair_gradient(const PairCorners<Dim>& corners, const PairLaw<Dim>& law);

/// Options of the mean along a step. Energy is as exact with each of them: they decide how much the correction takes up,
/// and so how accurate the force is.
struct PairPathOptions {
    /// Look closer where that is needed. The mean of the gradients at both ends is taken where its correction is below 1e-7
    /// of it; else Simpson's rule; else Gauss's rule on pieces, cut where faces begin or end to overlap and corners pass
    /// through the other face (2D), or where the contact begins or ends and in the middle of large steps (3D). Without, the
    /// mean of both ends.
    bool events = true;
    /// Gauss's rule for all pairs: on the pieces between events or, without them, on the whole step.
    bool gauss = false;
};

template <int Dim>
struct PairMeanGradient {
    double energy_0 = 0.0;         ///< W at the start [J]
    double energy_1 = 0.0;         ///< W at the end [J]
    double gap_0 = 0.0;            ///< least g of the overlap at the start, 0 where W = 0 [m]
    double gap_1 = 0.0;            ///< the same at the end
    PairCorners<Dim> gradient{};   ///< the discrete gradient: what stands for the mean of dW/dx [N]
    double area = 0.0;             ///< mean of the area where g < 0 [m^(Dim-1)]
    double active_share = 0.0;     ///< of the step, in which W > 0
    PairPressure<Dim> pressure{};  ///< mean over the step
    /// The part of the gradient that closes the balance of energy, as a force [N]. Large ones say that the step is too long
    /// to follow the pair.
    double correction = 0.0;
    int events = 0;       ///< cuts of the step, where it was integrated by pieces
    double facing = 1.0;  ///< the larger n_1 . n_2 of both ends
    /// Sum of n at the ends where the weight of the pair is not 0
    Vector<Dim> normal = Vector<Dim>::Zero();
};

/// A discrete gradient along the straight paths of the corners from x_0 to x_1:
///
///     sum gradient . (x_1 - x_0) = W(x_1) - W(x_0),   sum gradient = 0,   sum (x_0 + x_1)/2 x gradient = 0,
///
/// all to round-off, for steps of any size in which the pair turns by less than half a turn (else it is NaN where W acts);
/// it tends to dW/dx. W is integrated in a frame that turns with the pair; the rest goes along the motion in this frame.
template <int Dim>
[[nodiscard]] PairMeanGradient<Dim> pair_mean_gradient(const PairCorners<Dim>& x_0, const PairCorners<Dim>& x_1,
                                                       const PairLaw<Dim>& law, const PairPathOptions& options = {});

/// The end of a step of a pair, and the start of the next one: W, the least gap and the area of the part where g < 0,
/// n_1 . n_2, n, dW/dz in coordinates z that turn with the pair (2 Dim, Dim), and the pressures. A step that knows its start
/// is bitwise identical to one that finds it again.
template <int Dim>
using PairEnd = std::array<double, 4 + Dim + 2 * Dim*(Dim + 1)>;

/// A pair along one step, one of many that are integrated side by side.
template <int Dim>
struct PairStep {
    const PairCorners<Dim>* x_0;
    const PairCorners<Dim>* x_1;
    const PairLaw<Dim>* law;
    const PairEnd<Dim>* start;    ///< at x_0, under this law; null: it is found
    PairEnd<Dim>* end;            ///< result, at x_1
    PairMeanGradient<Dim>* mean;  ///< result
};

/// `pair_mean_gradient` of many pairs at a fraction of the cost. Each is bitwise identical to that pair by itself.
template <int Dim>
void integrate_pairs(std::span<const PairStep<Dim>> steps, const PairPathOptions& options = {});

/// As `integrate_pairs`, with dW/dx, the area and the pressures at x_1 in place of the means.
template <int Dim>
void evaluate_pairs(std::span<const PairStep<Dim>> steps);

}  // namespace abut::geometry
