#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/result.hpp"
#include "abut/run/watch/obstacle_watch.hpp"
#include "abut/run/watch/slow_cell.hpp"
#include "abut/run/words/bond_text.hpp"
#include "abut/run/words/counts.hpp"
#include "abut/run/words/warnings.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

void add_mesh(Counts& counts, const mesh::BuildReport& report, bool with_contact) {
    for (const std::string& warning : report.warnings)
        counts.warnings.push_back({WarningKind::mesh_file, Severity::warning, fmt::format("mesh file: {}", warning),
                                   std::numeric_limits<double>::quiet_NaN(), 0.0});
    counts.add(WarningKind::unused_vertices, Severity::note, report.n_unused_vertices,
               fmt::format("{} left out: no cell has such a corner",
                           counted(report.n_unused_vertices, "vertex is", "vertices are")));
    counts.add(WarningKind::ignored_elements, Severity::note, report.n_ignored_elements,
               fmt::format("{} left out: neither cells nor faces of a named group",
                           counted(report.n_ignored_elements, "element is", "elements are")));
    counts.add(
        WarningKind::turned_cells, Severity::note, report.n_turned_cells,
        fmt::format("{} turned: given inside out (clockwise)", counted(report.n_turned_cells, "cell is", "cells are")));
    counts.add(WarningKind::cut_cells, Severity::note, report.n_cut_cells,
               fmt::format("{} cut into tetrahedra, for {} not planar", counted(report.n_cut_cells, "cell is", "cells are"),
                           counted(report.n_non_planar_faces, "face that is", "faces that are")));
    counts.add(WarningKind::coincident_vertices, Severity::note, with_contact ? report.n_coincident_vertices : 0,
               fmt::format("{} on a vertex of another body: bodies that touch are not joined; [[bonds]] glue them",
                           counted(report.n_coincident_vertices, "vertex lies", "vertices lie")));
}

template <int Dim>
void add_unjoined(Counts& counts, const RunResult<Dim>& result) {
    const mesh::UnjoinedFaces& unjoined = result.bodies.unjoined;
    counts.add(
        WarningKind::unjoined_faces, Severity::warning, unjoined.n_faces,
        fmt::format("{} on faces of the same body without being joined to them, the first of body '{}' at ({:.4g}): "
                    "cells on both sides move apart freely{}. Where this is no crack, merge vertices that coincide, make a "
                    "mesh whose cells match, or make two bodies of it and bond them with [[bonds]]",
                    counted(unjoined.n_faces, "face lies", "faces lie"), unjoined.body,
                    fmt::join(std::span<const double>(unjoined.place).first(Dim), ", "),
                    result.options.contact.search.self_contact ? ", and touch where they come together again"
                                                               : " and through each other"));
}

/// Name of a body or an obstacle in messages.
template <int Dim>
std::string name_in(const Scene<Dim>& scene, std::int32_t body) {
    return (body < scene.mesh.n_bodies() ? "body " : "") + quoted_name(scene, body);
}

/// By the law that acts: what two faces that look at each other less than this miss, and how that is changed.
struct Seen {
    double cosine;  ///< -n_1 . n_2
    const char* verb;
    const char* remedy;
};
Seen seen_by(const RunOptions& options) {
    if (options.law == solid::ContactLaw::pair_potential)
        return {-contact::quarter_weight_cosine(options.facing), "hardly sees",
                "take a --facing-none nearer to 0, with a --facing-full below it"};
    return {-options.contact.search.facing_cosine, "does not see", "take a --facing-cosine nearer to 0"};
}

template <int Dim>
void add_corners(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const auto& corners = result.contact.blind_corners;
    if (corners.empty()) return;
    const Seen seen = seen_by(result.options);
    counts.add(
        WarningKind::blind_corners, Severity::warning, corners.size(),
        fmt::format("{} corners, one of them of {} at ({:.4g}), are so sharp that contact {} them meet a flat face: bodies "
                    "pass through each other there, or leave too fast. Blunt them, or {}",
                    corners.size(), name_in(scene, corners.front().body), fmt::join(corners.front().position, ", "),
                    seen.verb, seen.remedy));
}

/// The angle inside the body at an edge [degrees].
double degrees(double half_angle_sine) { return 2.0 * std::asin(half_angle_sine) * 180.0 / std::numbers::pi; }

template <int Dim>
void add_edges(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const auto& edges = result.contact.unseen_edges;
    if (!edges) return;
    const Seen seen = seen_by(result.options);
    counts.warnings.push_back(
        {WarningKind::unseen_edges, Severity::warning,
         fmt::format(
             "edges of {:.3g} and {:.3g} degrees, of {} at ({:.4g}) and {} at ({:.4g}), are so sharp that contact {} them "
             "cross: their faces look at each other by {:.3g}, more than {:.3g} is needed. Bodies pass through each other "
             "there. Blunt them, or {}",
             degrees(edges->edge_1.half_angle_sine), degrees(edges->edge_2.half_angle_sine),
             name_in(scene, edges->edge_1.body), fmt::join(edges->edge_1.midpoint, ", "), name_in(scene, edges->edge_2.body),
             fmt::join(edges->edge_2.midpoint, ", "), seen.verb, edges->facing(), seen.cosine, seen.remedy),
         edges->facing(), seen.cosine});
}

/// Warns that a body, or all of them, lie where an obstacle does nothing for them.
template <int Dim>
void add_behind(Counts& counts, const Scene<Dim>& scene) {
    for (const Behind& behind : behind_at_start(scene))
        counts.warnings.push_back(
            {WarningKind::behind_obstacle, Severity::warning,
             fmt::format(
                 "{} behind obstacle '{}', where nothing touches it: contact acts on the side that it faces. Turn it "
                 "around (normal of a plane, inside of a surface), or let the two pass through each other by name "
                 "(ignored_pairs)",
                 behind.body < 0 ? "all bodies are" : fmt::format("body '{}' is", scene.mesh.body_names[behind.body]),
                 name_of_obstacle(scene, static_cast<std::size_t>(behind.obstacle))),
             std::numeric_limits<double>::quiet_NaN(), 0.0});
}

template <int Dim>
void add_bonds(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    for (std::size_t i = 0; i < result.bonds.coverage.size(); ++i) {
        const solid::Bond& bond = scene.solid.bonds[i];
        const solid::BondCoverage& coverage = result.bonds.coverage[i];
        if (!(coverage.share() < enough_bond)) continue;
        counts.warnings.push_back(
            {WarningKind::missing_bond, Severity::warning,
             fmt::format(
                 "the bond of {} and {} holds {:.3g} of the {:.4g} {} where they lie opposite each other, {:g} is "
                 "needed: faces farther apart than a tenth of the smaller one are not bonded, and the largest gap "
                 "that is bonded is {:.3g} m. Move or turn the bodies together, or name by groups what is to be bonded",
                 quoted_side(scene, bond.sides[0]), quoted_side(scene, bond.sides[1]), coverage.share(), coverage.opposite,
                 Dim == 2 ? "m" : "m^2", enough_bond, coverage.largest_gap),
             coverage.share(), enough_bond});
    }
}

/// Warns that bonds open within less than a cell: of the one that does most.
template <int Dim>
void add_cohesive_length(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    if (!(cohesive_length(result.bonds.coverage) < enough_cohesive_length)) return;
    const auto worst = std::ranges::min_element(result.bonds.coverage, {}, &solid::BondCoverage::cohesive_length);
    const solid::Bond& bond = scene.solid.bonds[static_cast<std::size_t>(worst - result.bonds.coverage.begin())];
    counts.warnings.push_back(
        {WarningKind::short_cohesive_length, Severity::warning,
         fmt::format(
             "the bond of {} and {} opens over a length of {:.3g} cells (young fracture_energy/strength^2), {:g} is "
             "needed: stress at its cracks is not resolved, and what it bears depends on the mesh. Take cells {:.2g} "
             "times smaller, a lower strength or more fracture_energy",
             quoted_side(scene, bond.sides[0]), quoted_side(scene, bond.sides[1]), worst->cohesive_length,
             enough_cohesive_length, std::ceil(10.0 * enough_cohesive_length / worst->cohesive_length) / 10.0),
         worst->cohesive_length, enough_cohesive_length});
}

/// Warns of grains that bonds hold as springs, beside which stress scatters: of the first, and of how many more.
template <int Dim>
void add_scattered_grains(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::size_t n = 0;
    const solid::Bond* first = nullptr;
    for (const solid::Bond& bond : scene.solid.bonds) {
        if (!bond.of_grains) continue;  // one of its sides may be an obstacle
        const auto body = static_cast<std::size_t>(bond.sides[0]);
        const bool has_frame = solid::properties_of(kinematics_of(scene, result, body)).has_frame;
        if (has_frame && scene.solid.materials[body].law != solid::MaterialLaw::j2) continue;
        if (n++ == 0) first = &bond;
    }
    if (n == 0) return;
    counts.add(WarningKind::scattered_grains, Severity::warning, static_cast<std::int64_t>(n),
               fmt::format("springs hold the grains {} and {} together, and those of {} more: stress of cells beside "
                           "them is off by a fifth while they hold, its mean is right. Grains of elastic bodies that are "
                           "floating have it right",
                           quoted_side(scene, first->sides[0]), quoted_side(scene, first->sides[1]),
                           counted(static_cast<std::int64_t>(n) - 1, "bond")));
}

/// Warns that the mass of cells at their centroids leaves out a part of the inertia of bodies that turn: of the one that
/// lacks most, and of how many more.
template <int Dim>
void add_inertia(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::size_t n = 0, worst = 0;
    for (std::size_t body = 0; body < result.bodies.inertia.size(); ++body) {
        if (!solid::properties_of(kinematics_of(scene, result, body)).turns ||
            !(result.bodies.inertia[body].least() < enough_inertia))
            continue;
        if (n++ == 0 || result.bodies.inertia[body].least() < result.bodies.inertia[worst].least()) worst = body;
    }
    if (n == 0) return;
    const auto kinematics = kinematics_of(scene, result, worst);
    const double share = result.bodies.inertia[worst].least();
    counts.warnings.push_back(
        {WarningKind::missing_inertia, Severity::warning,
         fmt::format(
             "body '{}', which is {}, has {:.3g} of its moment of inertia, {:g} is enough{}: the mass of a cell is at "
             "its centroid. It turns and precesses too fast by {:.2g} %. Take smaller cells, or rigid{} where it "
             "does not bend",
             scene.mesh.body_names[worst], name_of(kinematics), share, enough_inertia,
             n > 1 ? fmt::format(" ({} less)",
                                 counted(static_cast<std::int64_t>(n - 1), "more body lacks", "more bodies lack"))
                   : "",
             100.0 * (1.0 / share - 1.0), solid::properties_of(kinematics).finite_strains ? " or floating" : ""),
         share, enough_inertia});
}

template <int Dim>
void add_slow_cell(Counts& counts, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const auto slow = slow_cell(scene, result);
    if (!slow || !(slow->share < slow_cell_share)) return;
    counts.warnings.push_back(
        {WarningKind::slow_cell, Severity::warning,
         fmt::format("{}, {:g} is enough: the step of the whole run is as short. Give the mesh cells of "
                     "more even size there, by another `size` or without slivers in its surface",
                     slow->text, slow_cell_share),
         slow->share, slow_cell_share});
}

}  // namespace

template <int Dim>
std::vector<Warning> warnings_before(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Counts counts;
    add_mesh(counts, scene.mesh.report, scene.contact);
    add_unjoined(counts, result);
    add_bonds(counts, scene, result);
    add_cohesive_length(counts, scene, result);
    add_scattered_grains(counts, scene, result);
    add_slow_cell(counts, scene, result);
    add_inertia(counts, scene, result);
    const auto& stencils = result.bodies.stencils;
    counts.add(WarningKind::extrapolated_faces, Severity::note, stencils.extrapolated,
               fmt::format("{} of {} faces extrapolate from the cells around them, worst weight {:.2g}: the stable step is "
                           "shorter",
                           stencils.extrapolated, stencils.faces, stencils.worst_weight));
    add_corners(counts, scene, result);
    add_edges(counts, scene, result);
    add_behind(counts, scene);
    if (const auto& options = result.options; options.restart > 0 && options.interval % options.restart == 0)
        counts.warnings.push_back(
            {WarningKind::hidden_mode, Severity::warning,
             fmt::format("with --interval {} and --restart {} every record comes right after a restart: H - H~ and |e|/m "
                         "before it are not seen. {}",
                         options.interval, options.restart,
                         options.restart == 1 ? std::string("Take a larger --restart")
                                              : fmt::format("Take an --interval that shares no factor with --restart, "
                                                            "such as {}",
                                                            options.interval + 1)),
             static_cast<double>(options.interval), static_cast<double>(options.restart)});
    return in_user_words(std::move(counts.warnings));
}

template std::vector<Warning> warnings_before<2>(const Scene<2>&, const RunResult<2>&);
template std::vector<Warning> warnings_before<3>(const Scene<3>&, const RunResult<3>&);

}  // namespace abut::run
