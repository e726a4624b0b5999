// What both drivers of contact save, restore, and take over from those of another mesh.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/solid/contact/pair_potential_driver.hpp"
#include "abut/solid/contact/reconstruction_driver.hpp"

namespace abut::solid {
namespace {

constexpr std::int32_t no_old_face = -1;

/// Old number of each face of contact: obstacles are behind the faces of bodies, and stay.
template <int Dim>
std::vector<std::int32_t> old_contact_faces(const ContactDriver<Dim>& before, std::int32_t n_before,
                                            const ContactDriver<Dim>& after, std::int32_t n_after,
                                            std::span<const std::int32_t> old_boundary) {
    std::vector<std::int32_t> of_boundary;  // face of contact before
    std::int32_t obstacles_before = 0;
    for (std::int32_t face = 0; face < n_before; ++face) {
        const BoundaryFace b = before.mesh_boundary(contact::Face{face});
        if (b == no_face) continue;
        obstacles_before = face + 1;
        of_boundary.resize(std::max(of_boundary.size(), static_cast<std::size_t>(b) + 1), no_old_face);
        of_boundary[static_cast<std::size_t>(b)] = face;
    }
    std::vector<std::int32_t> old;
    std::int32_t obstacle = obstacles_before;
    for (std::int32_t face = 0; face < n_after; ++face) {
        const BoundaryFace b = after.mesh_boundary(contact::Face{face});
        if (b == no_face) {
            old.push_back(obstacle++);
            continue;
        }
        const std::int32_t was = old_boundary[static_cast<std::size_t>(b)];
        old.push_back(was < 0 ? no_old_face : of_boundary[static_cast<std::size_t>(was)]);
    }
    if (obstacle != n_before)
        throw BadInput("a run goes on with other obstacles: they have " + std::to_string(obstacle - obstacles_before) +
                       " faces, and had " + std::to_string(n_before - obstacles_before) + ". Keep obstacles as they are.");
    return old;
}

}  // namespace

template <int Dim>
std::vector<std::byte> ReconstructionDriver<Dim>::state() const {
    return contact_->state();
}

template <int Dim>
void ReconstructionDriver<Dim>::restore(std::span<const std::byte> state, std::span<const Vector<Dim>> q, double time) {
    contact_->restore(state);
    search(q, q, time, 0.0);
    touching_.clear();
    has_stepped_ = true;
}

template <int Dim>
void ReconstructionDriver<Dim>::take_over(const ContactDriver<Dim>& other, std::span<const std::int32_t> old_boundary) {
    const auto& before = dynamic_cast<const ReconstructionDriver&>(other);
    contact_->take_over(*before.contact_,
                        old_contact_faces(before, before.surface_.size(), *this, surface_.size(), old_boundary));
}

template <int Dim>
std::vector<std::byte> PairPotentialDriver<Dim>::state() const {
    return contact_.state();
}

template <int Dim>
void PairPotentialDriver<Dim>::restore(std::span<const std::byte> state, std::span<const Vector<Dim>> q, double time) {
    contact_.restore(state);
    far_holds_ = false;
    search(q, q, 0.0, time, 0.0);
    keep_end(q);
    touching_.clear();
    end_time_ = time;
    has_stepped_ = true;
}

template <int Dim>
void PairPotentialDriver<Dim>::take_over(const ContactDriver<Dim>& other, std::span<const std::int32_t> old_boundary) {
    const auto& before = dynamic_cast<const PairPotentialDriver&>(other);
    contact_.take_over(before.contact_, old_contact_faces(before, before.contact_.surface().n_faces(), *this,
                                                          contact_.surface().n_faces(), old_boundary));
}

#define ABUT_INSTANTIATE(Dim)                                                                                           \
    template std::vector<std::byte> ReconstructionDriver<Dim>::state() const;                                           \
    template void ReconstructionDriver<Dim>::restore(std::span<const std::byte>, std::span<const Vector<Dim>>, double); \
    template void ReconstructionDriver<Dim>::take_over(const ContactDriver<Dim>&, std::span<const std::int32_t>);       \
    template std::vector<std::byte> PairPotentialDriver<Dim>::state() const;                                            \
    template void PairPotentialDriver<Dim>::restore(std::span<const std::byte>, std::span<const Vector<Dim>>, double);  \
    template void PairPotentialDriver<Dim>::take_over(const ContactDriver<Dim>&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
