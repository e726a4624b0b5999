#include "abut/contact/friction.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/option_table.hpp"

namespace abut::contact {
namespace {

[[noreturn]] void refuse(const std::string& name, double value, const std::string& allowed) {
    throw BadInput("friction: " + name + " is " + number(value) + "; " + allowed, {.value = value});
}

void check(const Friction& law) {
    check_options("", friction_options(), law);
    const bool decays = std::isfinite(law.decay_speed) || std::isfinite(law.decay_slip);
    if (!std::isnan(law.sliding_coefficient) && law.sliding_coefficient != law.coefficient && !decays)
        refuse("sliding_friction", law.sliding_coefficient,
               "say when it is reached: give `decay_speed` [m/s] or `decay_slip` [m].");
}

}  // namespace

double coefficient_of(const Friction& law, const Sliding& sliding) {
    if (law.own_coefficient) {
        const double mu = law.own_coefficient(sliding);
        if (!(mu >= 0.0) || !std::isfinite(mu))
            refuse("own_coefficient", mu,
                   "at a speed of " + number(sliding.speed) + " m/s, after " + number(sliding.slid) +
                       " m: it must give a number that is finite and >= 0.");
        return mu;
    }
    if (std::isnan(law.sliding_coefficient)) return law.coefficient;
    const double left = std::exp(-sliding.speed / law.decay_speed) * std::max(0.0, 1.0 - sliding.slid / law.decay_slip);
    return law.sliding_coefficient + (law.coefficient - law.sliding_coefficient) * left;
}

std::int32_t FrictionOptions::law_between(Face face_1, Face face_2) const {
    if (laws.empty()) return -1;
    const std::int32_t law = law_of ? law_of(face_1, face_2) : 0;
    if (law < -1 || law >= std::ssize(laws))
        throw BadInput("friction: faces " + std::to_string(number_of(face_1)) + " and " + std::to_string(number_of(face_2)) +
                           " are given law " + std::to_string(law) + " of " + std::to_string(laws.size()) +
                           "; laws are counted from 0, and -1 is none.",
                       {.face_1 = number_of(face_1), .face_2 = number_of(face_2), .value = static_cast<double>(law)});
    return law;
}

void check(const FrictionOptions& options) {
    for (const Friction& law : options.laws) check(law);
}

}  // namespace abut::contact
