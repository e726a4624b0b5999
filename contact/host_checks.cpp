#include "abut/contact/host_checks.hpp"

#include <algorithm>
#include <string>

#include "abut/base/error.hpp"
#include "abut/contact/messages.hpp"

namespace abut::contact {

void check_options(const ContactOptions& options) {
    const auto refuse = [](const std::string& what, double value) {
        throw BadInput("contact options: " + what, {.value = value});
    };
    if (options.quadrature < 0 || options.quadrature > 3)
        refuse("quadrature is " + std::to_string(options.quadrature) +
                   "; it must be 1, 2 or 3 points (0: as many as exactness needs).",
               options.quadrature);
    if (!(options.search.facing_cosine < 0.0))
        refuse("facing_cosine is " + number(options.search.facing_cosine) +
                   "; contact needs one between -1 and 0. -0.2 is the default.",
               options.search.facing_cosine);
    if (!(options.compression_warning > 0.0))
        refuse("compression_warning is " + number(options.compression_warning) + "; it must be > 0. 0.3 is the default.",
               options.compression_warning);
    if (!(options.compression_limit > 0.0))
        refuse("compression_limit is " + number(options.compression_limit) + "; it must be > 0. 2 is the default.",
               options.compression_limit);
}

template <int Dim>
void check_coupling(const FaceCoupling<Dim>& coupling, std::size_t n_faces) {
    const auto refuse = [](const std::string& what, const ErrorFacts& facts) {
        throw BadInput("contact: the coupling of the listed faces " + what, facts);
    };
    const std::size_t n = coupling.columns.size();
    if (coupling.offsets.size() != n_faces + 1 || coupling.offsets.front() != 0 ||
        static_cast<std::size_t>(coupling.offsets.back()) != n ||
        !std::is_sorted(coupling.offsets.begin(), coupling.offsets.end()))
        refuse("has " + std::to_string(coupling.offsets.size()) + " offsets for " + std::to_string(n_faces) + " faces and " +
                   std::to_string(n) +
                   " columns; they must be one more than faces and rise from 0 to the number of columns.",
               {.value = static_cast<double>(coupling.offsets.size()), .allowed = static_cast<double>(n_faces + 1)});
    if (coupling.blocks.size() != n)
        refuse("has " + std::to_string(coupling.blocks.size()) + " blocks for " + std::to_string(n) +
                   " columns; give one each.",
               {.value = static_cast<double>(coupling.blocks.size()), .allowed = static_cast<double>(n)});
    for (const std::int32_t column : coupling.columns)
        if (column < 0 || static_cast<std::size_t>(column) >= n_faces)
            refuse("names face " + std::to_string(column) + " of " + std::to_string(n_faces) +
                       "; columns are indices into Contact::faces.",
                   {.value = static_cast<double>(column), .allowed = static_cast<double>(n_faces)});
}

void check_listed(std::size_t size, std::size_t n_faces) {
    if (size != n_faces)
        throw BadInput("contact: the path of the listed faces has an array of " + std::to_string(size) + " entries for " +
                           std::to_string(n_faces) + " faces; give one for each of Contact::faces.",
                       {.value = static_cast<double>(size), .allowed = static_cast<double>(n_faces)});
}

template <int Dim>
void check_path(const SurfaceView<Dim>& surface, std::span<const SurfaceFace> faces, const FacePath<Dim>& path) {
    const std::size_t n_faces = faces.size();
    for (const std::size_t size :
         {path.displacement_0.size(), path.displacement_1.size(), path.gradient_0.size(), path.gradient_1.size()})
        check_listed(size, n_faces);
    for (std::size_t i = 0; i < n_faces; ++i)
        if (!path.displacement_0[i].allFinite() || !path.displacement_1[i].allFinite() || !path.gradient_0[i].allFinite() ||
            !path.gradient_1[i].allFinite())
            throw Diverged("contact: displacement or energy gradient of " + face_name(surface, number_of(faces[i])) +
                               " is not finite: the run has diverged. Take a smaller time step.",
                           {.face_1 = number_of(faces[i])});
}

template <int Dim>
void check_host_step(const SurfaceView<Dim>& surface, const HostStep<Dim>& host) {
    const auto n = static_cast<std::size_t>(surface.size());
    for (const std::size_t size : {host.displacement_0.size(), host.displacement_1.size()})
        if (size != n)
            throw BadInput("contact: " + std::to_string(size) + " displacements are given for " + std::to_string(n) +
                               " faces of the surface; give one each.",
                           {.value = static_cast<double>(size), .allowed = static_cast<double>(n)});
    if (!host.coupling_of || !host.gradients_of)
        throw BadInput(
            "contact: HostStep::coupling_of (asked after each search) and HostStep::gradients_of (asked at each step) must "
            "both be set.");
}

#define ABUT_INSTANTIATE(Dim)                                                                                   \
    template void check_coupling<Dim>(const FaceCoupling<Dim>&, std::size_t);                                   \
    template void check_path<Dim>(const SurfaceView<Dim>&, std::span<const SurfaceFace>, const FacePath<Dim>&); \
    template void check_host_step<Dim>(const SurfaceView<Dim>&, const HostStep<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
