#pragma once
// Private to the layer.
#include <cstdint>
#include <span>

#include "abut/contact/options.hpp"
#include "abut/contact/pair_list.hpp"
#include "abut/contact/pair_store.hpp"

namespace abut::contact {

/// What becomes of a pair that was not in the list before.
enum class FirstAdmission {
    admitted,
    not_admitted,
    missed,  ///< not admitted, though it is so shallow that it must have been a contact before anybody looked
};
/// Where a pair is pressed in when it is first seen it is no contact, unless the run only begins.
[[nodiscard]] inline FirstAdmission first_admission(bool is_shallow, bool is_pressed_in, bool run_begins) {
    if (run_begins || !is_pressed_in) return is_shallow ? FirstAdmission::admitted : FirstAdmission::not_admitted;
    return is_shallow ? FirstAdmission::missed : FirstAdmission::not_admitted;
}

/// Decides which pairs count as contacts where they are pressed in (A > 0 and g < 0), and which are far sides of bodies.
/// docs/method.md, Contact.
template <int Dim>
class Admission {
public:
    /// The surface and the list must outlive it.
    Admission(const SurfaceView<Dim>& surface, const PairList<Dim>& list, geometry::AreaMethod area)
        : surface_(surface), list_(list), area_(area) {}

    /// Whether A > 0 and g < 0 where its faces are displaced by u_1 and u_2 [m].
    [[nodiscard]] bool is_pressed_in(const ContactPair<Dim>& pair, const Vector<Dim>& u_1, const Vector<Dim>& u_2) const;

    /// Of a pair that was not in the list before. `u`: of all faces (n_faces) [m].
    [[nodiscard]] FirstAdmission decide_first(const ContactPair<Dim>& pair, std::span<const Vector<Dim>> u,
                                              bool run_begins) const;

    /// Where A min(g, 0) = 0 the flag of a pair may change without a change of the potential: there, and only there, it is
    /// decided again. `u`: of the listed faces [m]. Returns how many pairs are pressed in without being contacts.
    std::int64_t update(std::span<PairMemory> memory, std::span<const Vector<Dim>> u) const;

private:
    const SurfaceView<Dim>& surface_;
    const PairList<Dim>& list_;
    geometry::AreaMethod area_;
};

}  // namespace abut::contact
