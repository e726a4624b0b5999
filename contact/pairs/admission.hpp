#pragma once
// Private to the layer.

namespace abut::contact {

/// Outcome for a pair that was not in the list before.
enum class FirstAdmission {
    admitted,
    not_admitted,
    missed,  ///< not admitted, though it is so shallow that it must have been a contact before anybody looked
};
/// A look at a pair that was not in the list before.
struct FirstLook {
    FirstAdmission admission;
    double idle_overlap = 0.0;  ///< of one that is missed: how much of its overlap does not act, if it was kept apart [m]
};
/// A pair that is pressed in when it is first seen is no contact, unless the run only begins.
[[nodiscard]] inline FirstAdmission first_admission(bool is_shallow, bool is_pressed_in, bool run_begins) {
    if (run_begins || !is_pressed_in) return is_shallow ? FirstAdmission::admitted : FirstAdmission::not_admitted;
    return is_shallow ? FirstAdmission::missed : FirstAdmission::not_admitted;
}

}  // namespace abut::contact
