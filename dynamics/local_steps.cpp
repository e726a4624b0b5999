#include "abut/dynamics/local_steps.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "abut/dynamics/power_iteration.hpp"

namespace abut::dynamics {
namespace {

inline constexpr int probes = 3;              // random fields that the frequencies are estimated from
inline constexpr int products = 3;            // with M^-1 K, of each
inline constexpr double carries_mode = 0.01;  // of the largest kinetic energy of a cell in a mode: this cell carries it, too
inline constexpr double worth_a_level = 0.02;  // of all cells
inline constexpr int level_iterations = 20;

/// Level of each cell.
using Levels = std::vector<std::int32_t>;

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

/// The longest steps are those that `worth_a_level` of the cells can take.
Levels levels_of(const std::vector<double>& growth, int most_levels) {
    std::vector<double> sorted = growth;
    std::ranges::sort(sorted);
    const double least = sorted[static_cast<std::size_t>(worth_a_level * static_cast<double>(sorted.size() - 1))];
    const double most = sorted.back();
    const auto halvings = [&](double g) { return static_cast<std::int32_t>(std::floor(0.5 * std::log2(most / g))); };
    const std::int32_t finest = std::min(most_levels - 1, std::max(0, halvings(least)));
    Levels level;
    for (const double g : growth) level.push_back(std::max(0, finest - std::max(0, halvings(g))));
    return level;
}

template <int Dim>
std::vector<double> mask_up_to(const Levels& level, std::int32_t highest) {
    std::vector<double> mask;
    for (const std::int32_t l : level) mask.insert(mask.end(), Dim, l <= highest ? 1.0 : 0.0);
    return mask;
}

/// Moves cells to finer levels until the coarser ones are stable. omega_max of each level.
template <int Dim>
std::vector<double> make_stable(Solid<Dim>& solid, double finest_step, Levels& level) {
    const std::int32_t finest = *std::max_element(level.begin(), level.end());
    std::vector<double> omega_max;
    for (std::int32_t l = 0; l < finest;) {
        const double dt = finest_step * std::pow(2.0, finest - l);
        if (std::ranges::none_of(level, [&](std::int32_t other) { return other <= l; })) {
            omega_max.push_back(0.0);
            ++l;
            continue;
        }
        const double allowed = stable_step_of(solid, 1.0) / dt;  // of omega
        const std::vector<double> mask = mask_up_to<Dim>(level, l);
        const HighestMode mode = highest_mode(
            solid, {.least = level_iterations, .enough = std::pow(allowed / lower_bound_margin, 2), .mask = mask});
        const double omega = lower_bound_margin * std::sqrt(mode.quotient);
        if (!(mode.quotient > 0.0) || (omega <= allowed && !(mode.change <= settled_change)))
            throw std::runtime_error("local steps: the power iteration of level " + std::to_string(l) +
                                     " has not settled after " + std::to_string(mode.iterations) +
                                     " iterations. Check the mesh for slivers and the material for extreme values.");
        if (omega <= allowed) {
            omega_max.push_back(omega);
            ++l;
            continue;
        }
        const auto x = as_vectors<Dim>(std::span<const double>(mode.x));
        const auto share = [&](std::size_t c) { return solid.cell_mass()[c] * x[c].squaredNorm(); };
        double largest_share = 0.0;
        for (std::size_t c = 0; c < level.size(); ++c) largest_share = std::max(largest_share, share(c));
        for (std::size_t c = 0; c < level.size(); ++c)
            if (level[c] <= l && share(c) >= carries_mode * largest_share) level[c] = l + 1;
    }
    return omega_max;
}

/// Cells of the faces that contact may reach, and those that their displacement depends on.
template <int Dim>
std::vector<std::int32_t> contact_cells(Solid<Dim>& solid) {
    std::vector<std::int32_t> faces;
    for (std::int32_t b = 0; b < solid.ccg().n_boundary(); ++b)
        if (solid.ccg().prescribed()[b].isZero(0.0)) faces.push_back(b);
    std::vector<std::int32_t> cells;
    for (const std::int32_t b : faces) {
        cells.push_back(solid.mesh().face_cells[solid.mesh().boundary_faces[b]][0]);
        cells.insert(cells.end(), solid.ccg().cells_of(b).begin(), solid.ccg().cells_of(b).end());
    }
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

}  // namespace

template <int Dim>
SolidLocalSteps local_steps(Solid<Dim>& solid, const StableStep& stable, const LocalStepOptions& options) {
    const auto& [most_levels, contact_margin, contact_levels] = options;
    if (most_levels < 1 || most_levels > 20 || contact_margin < 0 || contact_levels < 0 || contact_levels > 10)
        throw std::invalid_argument("local steps: " + std::to_string(most_levels) + " levels, a margin of " +
                                    std::to_string(contact_margin) + " and " + std::to_string(contact_levels) +
                                    " more for contact are asked for; 1 to 20, at least 0 and 0 to 10 are allowed.");
    Levels level = levels_of(local_growth(solid), most_levels);
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
    local.dt = stable.dt * std::pow(2.0, finest);
    local.cells.assign(local.omega_max.size(), 0);
    for (std::size_t l = 0; l < local.omega_max.size(); ++l) local.steps.parts.push_back(std::int32_t{1} << l);
    for (const std::int32_t l : level) {
        ++local.cells[l];
        local.steps.level.insert(local.steps.level.end(), Dim, l);
    }
    return local;
}

template SolidLocalSteps local_steps<2>(Solid<2>&, const StableStep&, const LocalStepOptions&);
template SolidLocalSteps local_steps<3>(Solid<3>&, const StableStep&, const LocalStepOptions&);

}  // namespace abut::dynamics
