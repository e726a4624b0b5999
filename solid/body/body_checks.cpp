// What a solid is given, and may not be.
#include <algorithm>
#include <string>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/contact/interference.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/options/made_features.hpp"

namespace abut::solid {

template <int Dim>
void Bodies<Dim>::check() const {
    const auto n_bodies = static_cast<std::size_t>(mesh_.n_bodies());
    const auto require_one_each = [&](std::size_t given, const std::string& what) {
        if (given != n_bodies)
            throw BadInput(mesh_.name + ": " + what + ": " + std::to_string(given) + " given for " +
                               counted(std::int64_t(n_bodies), "body") + ". Give one per body" +
                               (what == "materials" ? "." : ", or none."),
                           {.value = static_cast<double>(given), .allowed = static_cast<double>(n_bodies)});
    };
    require_one_each(options_.materials.size(), "materials");
    for (std::size_t body = 0; body < n_bodies; ++body) solid::check(options_.materials[body], static_cast<int>(body));
    for (std::size_t body = 0; body < n_bodies; ++body) check_directions(body);
    if (!options_.acceleration.empty()) require_one_each(options_.acceleration.size(), "accelerations");
    if (!options_.kinematics.empty()) require_one_each(options_.kinematics.size(), "kinematics");
    if (!options_.temperature_rise.empty()) {
        require_one_each(options_.temperature_rise.size(), "temperatures");
        for (std::size_t body = 0; body < n_bodies; ++body) check_temperature(body);
    }
    for (std::size_t body = 0; body < options_.acceleration.size(); ++body)
        if (!options_.acceleration[body].allFinite())
            throw BadInput(mesh_.name + ": the acceleration of body " + std::to_string(body) + " ('" +
                           mesh_.body_names[body] + "') is not finite. Correct SolidOptions::acceleration.");
    if (!options_.obstacles.empty() && !options_.contact)
        throw BadInput(mesh_.name + ": " + std::to_string(options_.obstacles.size()) +
                       " obstacles are given without contact, so nothing would feel them. Give "
                       "SolidOptions::contact, or no obstacles.");
    if (options_.contact && !options_.contact->search.ignored_bodies.empty())
        throw BadInput(mesh_.name +
                       ": contact is to be ignored by bodies of its surface, which a solid numbers as it likes. Give "
                       "SolidOptions::ignored_pairs instead.");
    check_pairs();
    require_together(mesh_, options_);
    for (const auto& condition : options_.boundary.traction)
        if (condition.from_outside) check_outside(condition);
}

/// A body that is warm must expand.
template <int Dim>
void Bodies<Dim>::check_temperature(std::size_t body) const {
    if (!options_.temperature_rise[body].value || options_.materials[body].expansion.any()) return;
    throw BadInput(mesh_.name + ": body '" + mesh_.body_names[body] +
                   "' is given a temperature, and its material has a thermal_expansion of 0. Give one, or leave "
                   "SolidOptions::temperature_rise out.");
}

/// Axes of a material are given by an angle in the plane, and by two vectors in space.
template <int Dim>
void Bodies<Dim>::check_directions(std::size_t body) const {
    const Material& material = options_.materials[body];
    if (material.is_isotropic()) return;
    const Orthotropy &given = material.orthotropic, plain;
    const std::string who = mesh_.name + ": body '" + mesh_.body_names[body] + "' ";
    if (Dim == 2 && (given.axis_1 != plain.axis_1 || given.axis_2 != plain.axis_2))
        throw BadInput(
            who + "is in the plane, where axis_angle says how the axes of its material lie. Leave axis_1 and axis_2 out.");
    if (Dim == 3 && given.axis_angle != 0.0)
        throw BadInput(
            who + "is in space, where axis_1 and axis_2 say how the axes of its material lie. Leave axis_angle out.",
            {.value = given.axis_angle});
}

/// Friction and contact of pairs that are named by number.
template <int Dim>
void Bodies<Dim>::check_pairs() const {
    const std::int64_t n_all = mesh_.n_bodies() + std::ssize(options_.obstacles), n_sides = n_all + std::ssize(mesh_.groups);
    if (options_.contact && options_.contact->friction.any())
        throw BadInput(mesh_.name +
                       ": friction is given by faces of the surface of contact, which a solid numbers as it likes. Give "
                       "SolidOptions::friction and body_friction instead.");
    contact::check(contact::FrictionOptions{.laws = {options_.friction}});
    for (std::size_t i = 0; i < options_.body_friction.size(); ++i) {
        const BodyFriction& one = options_.body_friction[i];
        contact::check(contact::FrictionOptions{.laws = {one.law}});
        for (std::size_t j = 0; j < i; ++j)
            if (std::ranges::is_permutation(one.bodies, options_.body_friction[j].bodies))
                throw BadInput(mesh_.name + ": bodies or groups " + std::to_string(one.bodies[0]) + " and " +
                               std::to_string(one.bodies[1]) +
                               " have two laws of friction. Give one in SolidOptions::body_friction.");
        for (const std::int32_t body : one.bodies)
            if (body < 0 || body >= n_sides)
                throw BadInput(mesh_.name + ": friction is given for body or group " + std::to_string(body) +
                                   "; bodies, obstacles and groups are counted from 0 to " + std::to_string(n_sides - 1) +
                                   ". Correct SolidOptions::body_friction.",
                               {.value = static_cast<double>(body), .allowed = static_cast<double>(n_sides - 1)});
    }
    for (const auto& [pair, time] : options_.interference) {
        contact::check(contact::InterferenceOptions{.times = {time}});
        for (const std::int32_t side : pair)
            if (side < 0 || side >= n_sides)
                throw BadInput(mesh_.name + ": interference is given for body or group " + std::to_string(side) +
                                   "; bodies, obstacles and groups are counted from 0 to " + std::to_string(n_sides - 1) +
                                   ". Correct SolidOptions::interference.",
                               {.value = static_cast<double>(side), .allowed = static_cast<double>(n_sides - 1)});
    }
    for (const auto& pair : options_.ignored_pairs)
        for (const std::int32_t body : pair)
            if (body < 0 || body >= n_all)
                throw BadInput(mesh_.name + ": contact is to be ignored of body " + std::to_string(body) +
                                   "; bodies and obstacles are counted from 0 to " + std::to_string(n_all - 1) +
                                   ". Correct SolidOptions::ignored_pairs.",
                               {.value = static_cast<double>(body), .allowed = static_cast<double>(n_all - 1)});
}

template <int Dim>
void Bodies<Dim>::check_outside(const TractionCondition<Dim>& condition) const {
    const auto refuse = [&](const std::string& why) {
        throw BadInput(mesh_.name + ": the traction on '" + condition.group + "' is from outside, and " + why);
    };
    if (condition.history) refuse("has a history. Give one or the other.");
    if (!condition.value.allFinite()) refuse("its value at the start is not finite. Correct TractionCondition::value.");
    const auto is_same = [&](const auto& other) { return other.from_outside && other.group == condition.group; };
    if (std::ranges::count_if(options_.boundary.traction, is_same) > 1) refuse("is given twice. Leave one out.");
}

template void Bodies<2>::check() const;
template void Bodies<3>::check() const;

}  // namespace abut::solid
