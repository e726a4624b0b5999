#include "abut/solid/local_steps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/dynamics/power_iteration.hpp"

namespace abut::solid {
namespace {

inline constexpr int probes = 3;              // random fields that the frequencies are estimated from
inline constexpr int products = 3;            // with M^-1 K, of each
inline constexpr double carries_mode = 0.01;  // of the largest kinetic energy of a cell in a mode: this cell carries it, too
inline constexpr double worth_a_level = 0.02;  // of all cells
// A coarse step must be stable for the motions of its cells, and these reach so many layers into their neighbours.
inline constexpr int stable_layers = 2;
// A motion that changes its sign from one coarse step to the next resonates with them, even where finer steps resolve it:
// with two steps in one, its frequency is sqrt(2) times the highest that the coarse step allows. It must stay away from the
// coarse cells by so many layers, over which it dies away. Of graded discs that only fly, at 0.99 of the stable step, |e|
// grows from rounding with one layer above and three here, and does not within 10,000 steps with two and five.
inline constexpr int resonance_layers = 5;
inline constexpr double resonance = std::numbers::sqrt2;

/// Level of each cell.
using Levels = std::vector<std::int32_t>;

/// The largest value among a cell and those within `layers` faces of it.
template <int Dim, class T>
void spread_largest(const mesh::Mesh<Dim>& mesh, int layers, std::vector<T>& value) {
    for (int layer = 0; layer < layers; ++layer) {
        std::vector<T> spread = value;
        for (const auto& [c, d] : mesh.face_cells) {
            if (d < 0) continue;
            spread[c] = std::max(spread[c], value[d]);
            spread[d] = std::max(spread[d], value[c]);
        }
        value.swap(spread);
    }
}

/// Growth of random fields under M^-1 K, by cell: about omega^2 of what is near it.
template <int Dim>
std::vector<double> local_growth(Solid<Dim>& solid) {
    const std::size_t n = solid.size();
    std::vector<double> growth(n / Dim, 0.0), x(n), k_x(n);
    std::minstd_rand random(1);
    for (int probe = 0; probe < probes; ++probe) {
        for (double& value : x) value = random() % 2 == 0 ? 1.0 : -1.0;
        for (int i = 0; i < products; ++i) {
            solid.stiffness_product(x, k_x);
            for (std::size_t k = 0; k < n; ++k) x[k] = solid.inverse_mass()[k] * k_x[k];
        }
        const auto grown = as_vectors<Dim>(std::span<const double>(x));
        for (std::size_t c = 0; c < growth.size(); ++c)
            growth[c] = std::max(growth[c], std::pow(grown[c].norm() / std::sqrt(double(Dim)), 1.0 / products));
    }
    return growth;
}

/// A cell may have the longest step that is stable for it and that no motion within `resonance_layers` resonates with. The
/// longest of all are those that `worth_a_level` of the cells can take.
template <int Dim>
Levels levels_of(const mesh::Mesh<Dim>& mesh, const std::vector<double>& growth, int most_levels) {
    std::vector<double> nearby = growth;
    spread_largest(mesh, resonance_layers, nearby);
    std::vector<double> deciding;
    for (std::size_t c = 0; c < growth.size(); ++c)
        deciding.push_back(std::max(growth[c], nearby[c] / (resonance * resonance)));
    std::vector<double> sorted = deciding;
    std::ranges::sort(sorted);
    const double least = sorted[static_cast<std::size_t>(worth_a_level * static_cast<double>(sorted.size() - 1))];
    const double most = *std::ranges::max_element(growth);
    const auto halvings = [&](double g) { return static_cast<std::int32_t>(std::floor(0.5 * std::log2(most / g))); };
    const std::int32_t finest = std::min(most_levels - 1, std::max(0, halvings(least)));
    Levels level;
    for (const double g : deciding) level.push_back(std::max(0, finest - std::max(0, halvings(g))));
    return level;
}

/// The highest mode of some cells with the others held. `enough` is a frequency beyond which it need not settle [rad/s].
template <int Dim>
dynamics::HighestMode highest_mode_of(Solid<Dim>& solid, const std::vector<char>& chosen, double enough,
                                      std::int32_t level) {
    std::vector<double> mask;
    for (const char c : chosen) mask.insert(mask.end(), Dim, c ? 1.0 : 0.0);
    dynamics::HighestMode mode =
        dynamics::highest_mode(solid, {.enough = std::pow(enough / dynamics::lower_bound_margin, 2), .mask = mask});
    if (!(mode.quotient > 0.0) || (dynamics::bound_of(mode) <= enough && !(mode.change <= dynamics::settled_change)))
        throw BadInput("local steps: the power iteration of level " + std::to_string(level) + " has not settled after " +
                       std::to_string(mode.iterations) +
                       " iterations. Check the mesh for slivers and the material for extreme values.");
    return mode;
}

/// Cells that carry a mode.
template <int Dim>
std::vector<char> carriers(const Solid<Dim>& solid, const dynamics::HighestMode& mode) {
    const auto x = as_vectors<Dim>(std::span<const double>(mode.x));
    const auto share = [&](std::size_t c) { return solid.masses()[c] * x[c].squaredNorm(); };
    double largest = 0.0;
    for (std::size_t c = 0; c < x.size(); ++c) largest = std::max(largest, share(c));
    std::vector<char> carries(x.size());
    for (std::size_t c = 0; c < x.size(); ++c) carries[c] = share(c) >= carries_mode * largest;
    return carries;
}

/// Until no mode of the cells of level l and coarser, and of some layers about them, is above `limit` [rad/s]: those that
/// carry it, and as many layers about them, go to the next finer level. The highest frequency there is then; 0 without a
/// cell.
template <int Dim>
double refine_until_below(Solid<Dim>& solid, double limit, int layers, std::int32_t l, Levels& level) {
    for (;;) {
        std::vector<char> nearby;
        for (const std::int32_t other : level) nearby.push_back(other <= l);
        if (std::ranges::none_of(nearby, std::identity{})) return 0.0;
        spread_largest(solid.mesh(), layers, nearby);
        const dynamics::HighestMode mode = highest_mode_of(solid, nearby, limit, l);
        if (dynamics::bound_of(mode) <= limit) return dynamics::bound_of(mode);
        std::vector<char> carrying = carriers(solid, mode);
        spread_largest(solid.mesh(), layers, carrying);
        for (std::size_t c = 0; c < level.size(); ++c)
            if (carrying[c] && level[c] <= l) level[c] = l + 1;
    }
}

/// Moves cells to finer levels until the coarser ones are stable and away from what resonates with their step. omega_max of
/// all levels but the finest.
template <int Dim>
std::vector<double> make_stable(Solid<Dim>& solid, double finest_step, Levels& level) {
    const std::int32_t finest = *std::max_element(level.begin(), level.end());
    std::vector<double> omega_max;
    for (std::int32_t l = 0; l < finest; ++l) {
        const double allowed = dynamics::stable_step_of(solid, 1.0) / (finest_step * std::pow(2.0, finest - l));  // of omega
        omega_max.push_back(refine_until_below(solid, allowed, stable_layers, l, level));
        // It only takes cells away, so that the level stays stable.
        refine_until_below(solid, resonance * allowed, resonance_layers, l, level);
    }
    return omega_max;
}

/// The coarsest levels, as long as they hold fewer than `worth_a_level` of all cells together, go into the next finer one.
/// How many levels went.
std::int32_t merge_coarsest(Levels& level) {
    std::vector<std::int32_t> sorted = level;
    std::ranges::sort(sorted);
    const std::int32_t merged = sorted[static_cast<std::size_t>(worth_a_level * static_cast<double>(sorted.size() - 1))];
    for (std::int32_t& l : level) l = std::max(0, l - merged);
    return merged;
}

/// Cells of the faces that contact may reach, and those that their displacement depends on.
template <int Dim>
std::vector<std::int32_t> contact_cells(Solid<Dim>& solid) {
    std::vector<std::int32_t> cells;
    for (const BoundaryFace b : solid.ccg().boundary_faces()) {
        if (!solid.ccg().prescribed()[b].isZero(0.0)) continue;
        cells.push_back(cell_of(solid.mesh(), b));
        cells.insert(cells.end(), solid.ccg().cells_of(b).begin(), solid.ccg().cells_of(b).end());
    }
    sort_unique(cells);
    return cells;
}

}  // namespace

template <int Dim>
SolidLocalSteps local_steps(Solid<Dim>& solid, const dynamics::StableStep& stable, const LocalStepOptions& options) {
    const auto& [most_levels, contact_margin, contact_levels] = options;
    if (most_levels < 1 || most_levels > 20 || contact_margin < 0 || contact_levels < 0 || contact_levels > 10)
        throw BadInput("local steps: " + std::to_string(most_levels) + " levels, a margin of " +
                       std::to_string(contact_margin) + " and " + std::to_string(contact_levels) +
                       " more for contact are asked for; 1 to 20, at least 0 and 0 to 10 are allowed.");
    Levels level = levels_of(solid.mesh(), local_growth(solid), most_levels);
    const std::int32_t finest = *std::ranges::max_element(level);
    const std::vector<std::int32_t> in_contact = solid.contact() ? contact_cells(solid) : std::vector<std::int32_t>{};
    for (const std::int32_t c : in_contact) level[c] = std::min(finest, level[c] + contact_margin);
    SolidLocalSteps local;
    local.omega_max = make_stable(solid, stable.dt, level);
    local.omega_max.push_back(stable.omega_max);
    if (!in_contact.empty() && contact_levels > 0) {
        for (const std::int32_t c : in_contact) level[c] = finest + contact_levels;
        local.omega_max.insert(local.omega_max.end(), static_cast<std::size_t>(contact_levels), stable.omega_max);
    }
    const std::int32_t merged = merge_coarsest(level);
    local.omega_max.erase(local.omega_max.begin(), local.omega_max.begin() + merged);
    local.dt = stable.dt * std::pow(2.0, finest - merged);
    local.cells.assign(local.omega_max.size(), 0);
    for (std::size_t l = 0; l < local.omega_max.size(); ++l) local.steps.parts.push_back(std::int32_t{1} << l);
    for (const std::int32_t l : level) {
        ++local.cells[l];
        local.steps.level.insert(local.steps.level.end(), Dim, l);
    }
    return local;
}

template SolidLocalSteps local_steps<2>(Solid<2>&, const dynamics::StableStep&, const LocalStepOptions&);
template SolidLocalSteps local_steps<3>(Solid<3>&, const dynamics::StableStep&, const LocalStepOptions&);

}  // namespace abut::solid
