#include "abut/contact/law/finite_forces.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "abut/base/error.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::contact {
namespace {

constexpr double collapsed = 1e-10;  // of the measure of a facet at rest

template <int Dim>
std::array<Vector<Dim>, Dim> corners_of(const Surface<Dim>& facets, std::int32_t facet, PointsView<Dim> x) {
    std::array<Vector<Dim>, Dim> corners;
    for (int v = 0; v < Dim; ++v) corners[v] = x[facets.face_vertices[Dim * facet + v]];
    return corners;
}

template <int Dim>
std::string name_of(const NodalSurface<Dim>& surface, Face face) {
    const std::int32_t facet = surface.facet_offsets()[static_cast<std::size_t>(face)];
    return face_name(surface.facets().view(), facet, number_of(face));
}

/// Whether a facet has next to no area at one end of a step, or looks the other way at the end.
template <int Dim>
std::string collapse_of(const NodalSurface<Dim>& surface, std::int32_t facet, PointsView<Dim> x_0, PointsView<Dim> x_1) {
    const auto start = corners_of(surface.facets(), facet, x_0), end = corners_of(surface.facets(), facet, x_1);
    const double measure_0 = geometry::face_measure<Dim>(start), measure_1 = geometry::face_measure<Dim>(end);
    const double allowed = collapsed * surface.facets().area[facet];
    const bool collapses = !(measure_0 > allowed) || !(measure_1 > allowed);
    if (!collapses && geometry::face_normal<Dim>(start).dot(geometry::face_normal<Dim>(end)) > 0.0) return "";
    return "face " + std::to_string(number_of(surface.face_of(Facet{facet}))) +
           (collapses ? " loses its area" : " turns over and has no area in between") + " (from " + number(measure_0) +
           " to " + number(measure_1) + (Dim == 2 ? " m" : " m^2") + " in this step)";
}

[[noreturn]] void refuse(const std::string& name_1, const std::string& name_2, const std::string& why,
                         const ErrorFacts& facts) {
    throw Diverged("contact: the force between " + name_1 + " and " + name_2 + " is not finite, or above " +
                       number(largest_figure) + ": " + why,
                   facts);
}

std::string text_of_depth(double depth) { return "they are pressed " + number(depth) + " m into each other. "; }

}  // namespace

template <int Dim>
void refuse_pair(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair, const geometry::PairMeanGradient<Dim>& found,
                 PointsView<Dim> x_0, PointsView<Dim> x_1) {
    const Face face_1 = surface.face_of(Facet{pair.facet_1}), face_2 = surface.face_of(Facet{pair.facet_2});
    std::string why = collapse_of(surface, pair.facet_1, x_0, x_1);
    if (why.empty()) why = collapse_of(surface, pair.facet_2, x_0, x_1);
    if (why.empty())
        why = text_of_depth(-std::min(found.gap_0, found.gap_1)) + "The stiffness of the pair is " +
              number(pair.law.stiffness) + " Pa/m. Check stiffness, depths and units, or take a smaller time step.";
    else
        why += ". Take a smaller time step, or leave out faces that collapse.";
    refuse(name_of(surface, face_1), name_of(surface, face_2), why,
           {.face_1 = number_of(face_1),
            .face_2 = number_of(face_2),
            .value = magnitudes<Dim>(found),
            .allowed = largest_figure});
}

template <int Dim>
void check_bodies(const NodalStep<Dim>& step) {
    for (const BodyStep<Dim>& body : step.bodies)
        if (!std::isfinite(body.force.cwiseAbs().sum() + body.moment.cwiseAbs().sum() + std::abs(body.work)))
            throw Diverged("contact: forces, moments or work of body " + std::to_string(body.body) +
                           " are not finite: it is too far from the origin, or moves too far in the step. Take a smaller "
                           "time step, or other units.");
}

template <int Dim>
void check_forces(const SurfaceView<Dim>& surface, const ContactStep<Dim>& step) {
    const auto is_good = [](const PairStep<Dim>& pair) {
        return is_usable(pair.force.cwiseAbs().sum() + std::abs(pair.gap_0) + std::abs(pair.gap_1) + std::abs(pair.area) +
                         std::abs(pair.normal_force) + std::abs(pair.compression));
    };
    auto bad = std::ranges::find_if_not(step.pairs, is_good);
    if (bad == step.pairs.end() && is_usable(std::abs(step.energy))) return;
    if (bad == step.pairs.end())  // the energy: of the pair that is deepest
        bad = std::ranges::max_element(step.pairs, {}, [](const PairStep<Dim>& pair) { return pair.compression; });
    if (bad == step.pairs.end())
        throw Diverged(
            "contact: the energy of the corrections is not finite: the run has diverged. Take a smaller time step.");
    const std::int32_t face_1 = number_of(bad->face_1), face_2 = number_of(bad->face_2);
    refuse(face_name(surface, face_1), face_name(surface, face_2),
           text_of_depth(-std::min(bad->gap_0, bad->gap_1)) +
               "Check stiffness, displacements and units, or take a smaller time step.",
           {.face_1 = face_1, .face_2 = face_2, .value = bad->force.norm(), .allowed = largest_figure});
}

#define ABUT_INSTANTIATE(Dim)                                                                                               \
    template void refuse_pair<Dim>(const NodalSurface<Dim>&, const NodalPair<Dim>&, const geometry::PairMeanGradient<Dim>&, \
                                   PointsView<Dim>, PointsView<Dim>);                                                       \
    template void check_bodies<Dim>(const NodalStep<Dim>&);                                                                 \
    template void check_forces<Dim>(const SurfaceView<Dim>&, const ContactStep<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
