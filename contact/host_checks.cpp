#include "abut/contact/host_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/contact/surface/face_name.hpp"

namespace abut::contact {
namespace {

/// Rounding of a host's own sums, in parts of the largest entry of the blocks that are compared.
constexpr double coupling_rounding = 1e-10;

template <int Dim>
struct CouplingCheck {
    const SurfaceView<Dim>& surface;
    std::span<const Face> faces;
    const FaceCoupling<Dim>& coupling;

    void sizes() const {
        const std::size_t n = coupling.columns.size(), n_faces = faces.size();
        if (coupling.offsets.size() != n_faces + 1 || coupling.offsets.front() != 0 ||
            static_cast<std::size_t>(coupling.offsets.back()) != n ||
            !std::is_sorted(coupling.offsets.begin(), coupling.offsets.end()))
            refuse("has " + std::to_string(coupling.offsets.size()) + " offsets for " + std::to_string(n_faces) +
                       " faces and " + std::to_string(n) +
                       " columns; they must be one more than faces and rise from 0 to the number of columns.",
                   {.value = static_cast<double>(coupling.offsets.size()), .allowed = static_cast<double>(n_faces + 1)});
        if (coupling.blocks.size() != n)
            refuse("has " + std::to_string(coupling.blocks.size()) + " blocks for " + std::to_string(n) +
                       " columns; give one each.",
                   {.value = static_cast<double>(coupling.blocks.size()), .allowed = static_cast<double>(n)});
    }

    /// Checks the columns of row f: within range, increasing, finite, and f itself among them unless it is rigid: it
    /// takes no correction.
    void columns_of(std::size_t f) const {
        const std::int32_t n_faces = static_cast<std::int32_t>(faces.size());
        for (std::int32_t i = begin(f); i < end(f); ++i) {
            const std::int32_t column = coupling.columns[at(i)];
            if (column < 0 || column >= n_faces)
                refuse(row(f) + "names face " + std::to_string(column) + " of " + std::to_string(n_faces) +
                           "; columns are indices into Contact::faces.",
                       {.face_1 = face(f), .value = static_cast<double>(column), .allowed = static_cast<double>(n_faces)});
            if (i > begin(f) && column <= coupling.columns[at(i) - 1])
                refuse(row(f) + "has column " + std::to_string(column) + " after " +
                           std::to_string(coupling.columns[at(i) - 1]) +
                           "; columns must increase within a row. Sort them, and add up blocks of one column.",
                       {.face_1 = face(f), .face_2 = face(at(column))});
            if (!block(i).allFinite())
                refuse(row(f) + "has a block with column " + std::to_string(column) +
                           " that is not finite. Check the stiffness of the cells behind these faces.",
                       {.face_1 = face(f), .face_2 = face(at(column))});
        }
        if (find(f, f) < 0 && !surface.is_rigid(face(f)))
            refuse(row(f) + "lacks the column of the face itself, " + std::to_string(f) +
                       ". Give its block Q_ff; only rows of rigid faces may be empty.",
                   {.face_1 = face(f)});
    }

    /// A correction never takes energy out: no eigenvalue of Q_ff is negative.
    void own_block(std::size_t f) const {
        const std::int32_t own = find(f, f);
        if (own < 0) return;
        const Matrix<Dim> symmetric = 0.5 * (block(own) + block(own).transpose());
        const double least = symmetric_eigenvalues(symmetric)[0];
        const double allowed = -coupling_rounding * largest_entry(own);
        if (least < allowed)
            refuse(row(f) + "has a block on the diagonal with the eigenvalue " + number(least) + " N/m, " + number(allowed) +
                       " is allowed: it must be positive semi-definite. Q is the second derivative of the energy; check "
                       "its sign.",
                   {.face_1 = face(f), .value = least, .allowed = allowed});
    }

    /// Q_ff' is the transpose of Q_f'f, as second derivatives are.
    void symmetry(std::size_t f) const {
        for (std::int32_t i = begin(f); i < end(f); ++i) {
            const std::size_t other = at(coupling.columns[at(i)]);
            const std::int32_t twin = find(other, f);
            if (twin < 0)
                refuse(row(f) + "has column " + std::to_string(other) + ", but the row of " +
                           face_name(surface, face(other)) + " lacks column " + std::to_string(f) +
                           ". Give both blocks, or none.",
                       {.face_1 = face(f), .face_2 = face(other)});
            const double difference = (block(i) - block(twin).transpose()).cwiseAbs().maxCoeff();
            const double allowed =
                coupling_rounding * std::max({largest_entry(i), largest_entry(twin), largest_entry(find(f, f)),
                                              largest_entry(find(other, other))});
            if (difference > allowed)
                refuse(row(f) + "has a block with " + face_name(surface, face(other)) + " that differs by " +
                           number(difference) + " N/m from the transpose of that one's block with it, " + number(allowed) +
                           " is allowed. Q is the second derivative of an energy; check the indices of its blocks.",
                       {.face_1 = face(f), .face_2 = face(other), .value = difference, .allowed = allowed});
        }
    }

private:
    [[noreturn]] static void refuse(const std::string& what, const ErrorFacts& facts) {
        throw BadInput("contact: the coupling of the listed faces " + what, facts);
    }
    template <class Index>
    static std::size_t at(Index i) {
        return static_cast<std::size_t>(i);
    }
    [[nodiscard]] std::int32_t begin(std::size_t f) const { return coupling.offsets[f]; }
    [[nodiscard]] std::int32_t end(std::size_t f) const { return coupling.offsets[f + 1]; }
    [[nodiscard]] const Matrix<Dim>& block(std::int32_t i) const { return coupling.blocks[at(i)]; }
    [[nodiscard]] std::int32_t face(std::size_t f) const { return number_of(faces[f]); }
    [[nodiscard]] std::string row(std::size_t f) const { return "in the row of " + face_name(surface, face(f)) + " "; }
    [[nodiscard]] double largest_entry(std::int32_t i) const { return i < 0 ? 0.0 : block(i).cwiseAbs().maxCoeff(); }
    /// Index of the block of row f and this column, -1 where there is none.
    [[nodiscard]] std::int32_t find(std::size_t f, std::size_t column) const {
        const auto from = coupling.columns.begin() + begin(f), to = coupling.columns.begin() + end(f);
        const auto found = std::lower_bound(from, to, static_cast<std::int32_t>(column));
        return found == to || at(*found) != column ? -1 : static_cast<std::int32_t>(found - coupling.columns.begin());
    }
};

}  // namespace

void check_options(const ContactOptions& options) { check_options("contact options: ", contact_options(), options); }
void check_options(const NodalOptions& options) { check_options("nodal contact: ", nodal_options(), options); }

void check_friction(const FrictionOptions& friction, bool has_shear_stiffness) {
    check(friction);
    if (friction.any() && !has_shear_stiffness)
        throw BadInput(
            "contact: friction needs the shear stiffness of faces, by which they stick: give `shear_stiffness` of the "
            "surface, "
            "and `face_shear_stiffness` where `face_stiffness` is given.");
}

void check_step_length(double dt) {
    if (!(dt > 0.0) || !std::isfinite(dt))
        throw BadInput("contact: a step has the length dt = " + number(dt) +
                           " s; it must be finite and > 0. Give the time from the start of the step to its end.",
                       {.value = dt});
}

void check_old_faces(std::span<const std::int32_t> old_face_of, std::int32_t n_faces, std::int32_t n_old) {
    if (old_face_of.size() != static_cast<std::size_t>(n_faces))
        throw BadInput("contact: old numbers of " + std::to_string(old_face_of.size()) +
                       " faces are given, the surface has " + std::to_string(n_faces) +
                       " faces; give one each, -1 for a face that was not there.");
    std::vector<char> is_taken(static_cast<std::size_t>(n_old), 0);
    for (std::size_t face = 0; face < old_face_of.size(); ++face) {
        const std::int32_t old = old_face_of[face];
        if (old == -1) continue;
        const std::string who =
            "contact: face " + std::to_string(face) + " is said to have been face " + std::to_string(old) + ", ";
        const ErrorFacts facts{.face_1 = static_cast<std::int64_t>(face)};
        if (old < 0 || old >= n_old)
            throw BadInput(
                who + "but there were " + std::to_string(n_old) + " faces. Give -1 for a face that was not there.", facts);
        if (std::exchange(is_taken[static_cast<std::size_t>(old)], 1) != 0)
            throw BadInput(who + "which another one is, too.", facts);
    }
}

template <int Dim>
void check_coupling(const SurfaceView<Dim>& surface, std::span<const Face> faces, const FaceCoupling<Dim>& coupling) {
    const CouplingCheck<Dim> check{surface, faces, coupling};
    check.sizes();
    for (std::size_t f = 0; f < faces.size(); ++f) check.columns_of(f);
    for (std::size_t f = 0; f < faces.size(); ++f) check.own_block(f);
    for (std::size_t f = 0; f < faces.size(); ++f) check.symmetry(f);
}

void check_listed(std::size_t size, std::size_t n_faces) {
    if (size != n_faces)
        throw BadInput("contact: the path of the listed faces has an array of " + std::to_string(size) + " entries for " +
                           std::to_string(n_faces) + " faces; give one for each of Contact::faces.",
                       {.value = static_cast<double>(size), .allowed = static_cast<double>(n_faces)});
}

template <int Dim>
void check_path(const SurfaceView<Dim>& surface, std::span<const Face> faces, const FacePath<Dim>& path) {
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

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template void check_coupling<Dim>(const SurfaceView<Dim>&, std::span<const Face>, const FaceCoupling<Dim>&); \
    template void check_path<Dim>(const SurfaceView<Dim>&, std::span<const Face>, const FacePath<Dim>&);         \
    template void check_host_step<Dim>(const SurfaceView<Dim>&, const HostStep<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
