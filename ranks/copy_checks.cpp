#include "abut/ranks/copy_checks.hpp"

#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::ranks {
namespace {

constexpr double copy_tolerance = 1e-6;  // how far copies of a node may be apart, over the mean size of faces
constexpr double mass_tolerance = 1e-9;  // how much their masses may differ, relative

template <int Dim>
double mean_face_size(const contact::Surface<Dim>& facets) {
    double sum = 0.0;
    for (const double area : facets.area) sum += Dim == 2 ? area : std::sqrt(area);
    return facets.size() > 0 ? sum / facets.size() : 0.0;
}

template <int Dim>
std::vector<char> deformable_nodes(const contact::NodalSurface<Dim>& surface) {
    std::vector<char> is_deformable(static_cast<std::size_t>(surface.n_nodes()), 0);
    const contact::Surface<Dim>& facets = surface.facets();
    for (std::size_t i = 0; i < facets.face_vertices.size(); ++i)
        if (!surface.is_rigid(facets.body[i / Dim])) is_deformable[static_cast<std::size_t>(facets.face_vertices[i])] = 1;
    return is_deformable;
}

}  // namespace

template <int Dim>
CopyChecks<Dim>::CopyChecks(int rank, const SharedNumbers& numbers, const contact::NodalSurface<Dim>& surface)
    : rank_(rank),
      numbers_(numbers),
      is_deformable_(deformable_nodes(surface)),
      allowed_distance_(copy_tolerance * mean_face_size<Dim>(surface.facets())) {}

template <int Dim>
void CopyChecks<Dim>::check_size(std::int64_t size) const {
    if (size != numbers_.n_own)
        throw BadInput("shared nodal contact: values of " + std::to_string(size) + " nodes are given on rank " +
                           std::to_string(rank_) + ", which has " + std::to_string(numbers_.n_own) +
                           ". Give all nodes of the rank.",
                       {.value = static_cast<double>(size), .allowed = static_cast<double>(numbers_.n_own)});
}

template <int Dim>
void CopyChecks<Dim>::check_copies(PointsView<Dim> x, std::span<const Vector<Dim>> of_owners,
                                   std::span<const NodeGather::Here> copies) const {
    for (const NodeGather::Here& node : copies) {
        const Vector<Dim>& of_owner = of_owners[static_cast<std::size_t>(node.surface)];
        const double distance = (x[node.own] - of_owner).norm();
        if (distance <= allowed_distance_ || !of_owner.allFinite()) continue;
        throw BadInput("shared nodal contact: node " + name_of_copy(node) + " are " + number(distance) + " m apart, " +
                           number(allowed_distance_) +
                           " m is allowed. Copies of a node move alike: give each the forces of all parts.",
                       {.value = distance, .allowed = allowed_distance_});
    }
}

template <int Dim>
void CopyChecks<Dim>::check_masses(std::span<const double> mass, std::span<const NodeGather::Here> owned) const {
    check_size(std::ssize(mass));
    for (const NodeGather::Here& node : owned) {
        const auto at = static_cast<std::size_t>(node.surface);
        const double value = mass[static_cast<std::size_t>(node.own)];
        if (is_deformable(at) && !(value > 0.0))
            throw BadInput("shared nodal contact: node " + std::to_string(numbers_.node[at]) + " has the mass " +
                               number(value) + " kg on rank " + std::to_string(rank_) +
                               "; it must be > 0 where a face is deformable.",
                           {.value = value});
    }
}

template <int Dim>
void CopyChecks<Dim>::check_copies(std::span<const double> mass, std::span<const Vector<1>> of_owners,
                                   std::span<const NodeGather::Here> copies) const {
    for (const NodeGather::Here& node : copies) {
        const double of_owner = of_owners[static_cast<std::size_t>(node.surface)][0];
        const double here = mass[static_cast<std::size_t>(node.own)];
        if (std::abs(here - of_owner) <= mass_tolerance * of_owner) continue;
        throw BadInput("shared nodal contact: node " + name_of_copy(node) + " have the masses " + exact_number(here) +
                           " kg and " + exact_number(of_owner) +
                           " kg. Give the whole mass of a node on each rank that has it.",
                       {.value = here, .allowed = of_owner});
    }
}

template <int Dim>
std::string CopyChecks<Dim>::name_of_copy(const NodeGather::Here& node) const {
    const auto at = static_cast<std::size_t>(node.surface);
    return std::to_string(numbers_.node[at]) + ": its copies on ranks " + std::to_string(rank_) + " and " +
           std::to_string(numbers_.owner[at]);
}

template class CopyChecks<2>;
template class CopyChecks<3>;

}  // namespace abut::ranks
