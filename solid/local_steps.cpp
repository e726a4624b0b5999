#include "abut/solid/local_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/dynamics/mode_search.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

inline constexpr int probes = 3;             // random fields that the frequencies are estimated from
inline constexpr int products = 3;           // with M^-1 K, of each
inline constexpr double carries_mode = 0.1;  // of the largest kinetic energy of a cell in a mode: this cell carries it, too
inline constexpr double worth_a_level = 0.02;  // of all cells
// A coarse step must be stable for the motions of its cells, and these reach so many layers into their neighbours.
inline constexpr int stable_layers = 2;
// A motion that changes its sign from one coarse step to the next resonates with them, even where finer steps resolve it:
// with two steps in one, its frequency is sqrt(2) times the highest that the coarse step allows. It must stay away from the
// coarse cells by so many layers, over which it dies away. Of graded discs that only fly, at 0.99 of the stable step, |e|
// grows from rounding with one layer above and three here, and does not within 10,000 steps with two and five.
inline constexpr int resonance_layers = 5;
inline constexpr double resonance = std::numbers::sqrt2;
// Of the search for modes that are not allowed, iterations: before the first of them are looked at, before what is left of
// them is, and before it may count as settled.
inline constexpr int first_iterations = 10, further_iterations = 4, least_iterations = 20, most_iterations = 1000;
inline constexpr double settled_search_change = 1e-4;  // of its quotient

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

/// In units of the finest step, the step that each cell must be stable for: the longest of those within `stable_layers`, and
/// of those within `resonance_layers` over sqrt(2). A motion of cells with these steps, (s_c/2)^2 M^-1 K x = lambda x, that
/// has lambda <= 1 is stable on every level and resonates with none: on the cells about one level, s_c is that of the level
/// at least.
template <int Dim>
std::vector<double> steps_to_bear(const mesh::Mesh<Dim>& mesh, const Levels& level, std::int32_t finest) {
    std::vector<double> stable, resonant;
    for (const std::int32_t l : level) stable.push_back(std::ldexp(1.0, finest - l));
    spread_largest(mesh, stable_layers, stable);
    resonant = stable;
    spread_largest(mesh, resonance_layers - stable_layers, resonant);
    for (std::size_t c = 0; c < stable.size(); ++c) stable[c] = std::max(stable[c], resonant[c] / resonance);
    return stable;
}

/// The value of each cell and of the cells behind its faces together.
template <int Dim>
std::vector<double> sums_with_neighbours(const mesh::Mesh<Dim>& mesh, const std::vector<double>& value) {
    std::vector<double> sum = value;
    for (const auto& [c, d] : mesh.face_cells) {
        if (d < 0) continue;
        sum[c] += value[d];
        sum[d] += value[c];
    }
    return sum;
}

/// Cells that carry a mode of those steps that is not allowed, of the whole or of a place: where the Rayleigh quotient of
/// what is near exceeds `enough`, those that move most there.
template <int Dim>
std::vector<char> carriers(const Solid<Dim>& solid, const dynamics::ModeSearch& search, const std::vector<double>& steps,
                           double enough) {
    const auto n = steps.size();
    std::vector<double> share(n), energy(n);
    parallel_each(static_cast<std::ptrdiff_t>(n), [&](std::ptrdiff_t c) {
        const double mass = solid.masses()[c] / (steps[c] * steps[c]);
        for (std::size_t i = static_cast<std::size_t>(c) * Dim; i < static_cast<std::size_t>(c + 1) * Dim; ++i) {
            share[c] += mass * search.x()[i] * search.x()[i];
            energy[c] += mass * search.x()[i] * search.image(i);
        }
    });
    const std::vector<double> shares = sums_with_neighbours(solid.mesh(), share),
                              energies = sums_with_neighbours(solid.mesh(), energy);
    std::vector<double> nearby = share;
    spread_largest(solid.mesh(), resonance_layers, nearby);
    const double largest = *std::ranges::max_element(share);
    std::vector<char> carries(n);
    for (std::size_t c = 0; c < n; ++c)
        carries[c] = share[c] >= carries_mode * largest ||
                     (energies[c] > enough * shares[c] && share[c] > 0.0 && share[c] >= carries_mode * nearby[c]);
    return carries;
}

/// Moves to the next finer level the cells whose steps a carrier has to bear.
template <int Dim>
void refine_about(const mesh::Mesh<Dim>& mesh, const std::vector<char>& carries, const std::vector<double>& steps,
                  std::int32_t finest, Levels& level) {
    // The negative of the shortest step that a carrier near each cell has to bear; none: below all.
    std::vector<double> stable(level.size());
    for (std::size_t c = 0; c < level.size(); ++c)
        stable[c] = carries[c] ? -steps[c] : -std::numeric_limits<double>::infinity();
    spread_largest(mesh, stable_layers, stable);
    std::vector<double> resonant = stable;
    spread_largest(mesh, resonance_layers - stable_layers, resonant);
    for (std::size_t c = 0; c < level.size(); ++c) {
        const double step = std::ldexp(1.0, finest - level[c]);
        if (level[c] < finest && (step >= -stable[c] || step / resonance >= -resonant[c])) ++level[c];
    }
}

/// 0 for cells that bear the finest step alone, which is stable for all.
template <int Dim>
std::vector<double> weights_of(const Solid<Dim>& solid, const std::vector<double>& steps, double finest_step) {
    std::vector<double> weights(solid.size(), 0.0);
    for (std::size_t i = 0; i < steps.size() * Dim; ++i) {
        const double half_step = 0.5 * finest_step * steps[i / Dim];
        if (steps[i / Dim] > 1.0) weights[i] = half_step * half_step * solid.inverse_mass()[i];
    }
    return weights;
}

/// Whether the search has an answer: it goes on until the quotient has settled, or is beyond `enough`.
bool is_done(const dynamics::ModeSearch& search, double enough, int least_beyond) {
    if (search.quotient() > enough) return search.iterations() >= least_beyond;
    if (search.iterations() >= most_iterations)
        throw BadInput("local steps: the search for the highest mode has not settled after " +
                       std::to_string(search.iterations()) +
                       " iterations. Check the mesh for slivers and the material for extreme values.");
    return search.iterations() >= least_iterations && search.change() <= settled_search_change;
}

/// Moves cells to finer levels until the coarser ones are stable and away from what resonates with their steps. All levels
/// are looked at together, each cell with the longest step that it has to bear. The part of the allowed frequencies that is
/// reached then, 0 if all cells are on the finest level.
template <int Dim>
double make_stable(Solid<Dim>& solid, double finest_step, Levels& level) {
    const std::int32_t finest = *std::max_element(level.begin(), level.end());
    const double margin = dynamics::step_margin(solid);
    const double enough = std::pow(margin / dynamics::lower_bound_margin, 2);
    dynamics::ModeSearch search(
        solid.size(), [&](std::span<const double> x, std::span<double> product) { solid.stiffness_product(x, product); });
    bool is_fresh = true;  // the search began from a random field: it has not followed one place and forgotten the others
    for (;;) {
        if (std::ranges::all_of(level, [&](std::int32_t l) { return l == finest; })) return 0.0;
        const std::vector<double> steps = steps_to_bear(solid.mesh(), level, finest);
        search.set_weights(weights_of(solid, steps, finest_step));
        do search.iterate();
        while (!is_done(search, enough, is_fresh ? first_iterations : further_iterations));
        if (search.quotient() > enough) {
            refine_about(solid.mesh(), carriers(solid, search, steps, enough), steps, finest, level);
            is_fresh = false;
            continue;
        }
        if (is_fresh) return dynamics::lower_bound_margin * std::sqrt(search.quotient()) / margin;
        search.restart();
        is_fresh = true;
    }
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
        if (solid.ccg().prescribed()[b].isIdentity(1e-12)) continue;
        cells.push_back(cell_of(solid.mesh(), b));
        cells.insert(cells.end(), solid.ccg().cells_of(b).begin(), solid.ccg().cells_of(b).end());
    }
    sort_unique(cells);
    return cells;
}

}  // namespace

template <int Dim>
SolidLocalSteps local_steps(Solid<Dim>& solid, const dynamics::StableStep& stable, const LocalStepOptions& options) {
    require_together(solid.mesh(), solid.options(), features_of(solid.ranks()) | FeatureSet{Feature::local_steps});
    const auto& [most_levels, contact_margin, contact_levels] = options;
    if (most_levels < 1 || most_levels > 20 || contact_margin < 0 || contact_levels < 0 || contact_levels > 10)
        throw BadInput("local steps: " + std::to_string(most_levels) + " levels, a margin of " +
                       std::to_string(contact_margin) + " and " + std::to_string(contact_levels) +
                       " more for contact are asked for; 1 to 20, at least 0 and 0 to 10 are allowed.");
    Levels level = levels_of(solid.mesh(), local_growth(solid), most_levels);
    const std::int32_t finest = *std::ranges::max_element(level);
    const std::vector<std::int32_t> in_contact =
        solid.contact().reconstruction() ? contact_cells(solid) : std::vector<std::int32_t>{};
    for (const std::int32_t c : in_contact) level[c] = std::min(finest, level[c] + contact_margin);
    SolidLocalSteps local;
    const double reached = make_stable(solid, stable.dt, level);
    for (std::int32_t l = 0; l < finest; ++l)
        local.omega_max.push_back(reached * dynamics::stable_step_of(solid, 1.0) /
                                  (stable.dt * std::ldexp(1.0, finest - l)));
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
