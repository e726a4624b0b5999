#include "abut/contact/law/interference_ramps.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/messages.hpp"

namespace abut::contact {

std::int32_t InterferenceOptions::between(Face face_1, Face face_2) const {
    if (times.empty()) return -1;
    const std::int32_t index = of ? of(face_1, face_2) : 0;
    if (index < -1 || index >= std::ssize(times))
        throw BadInput("interference: faces " + std::to_string(number_of(face_1)) + " and " +
                           std::to_string(number_of(face_2)) + " are given time " + std::to_string(index) + " of " +
                           std::to_string(times.size()) + "; times are counted from 0, and -1 is none.",
                       {.face_1 = number_of(face_1), .face_2 = number_of(face_2), .value = static_cast<double>(index)});
    return index;
}

void check(const InterferenceOptions& options) {
    for (const double time : options.times)
        if (!(time > 0.0) || !std::isfinite(time))
            throw BadInput("interference: the time over which an overlap comes to act is " + number(time) +
                               " s; it must be finite and > 0 s.",
                           {.value = time});
}

void InterferenceRamps::begin(std::vector<double> overlaps) { overlaps_ = std::move(overlaps); }

void InterferenceRamps::look_ahead(double dt) {
    const auto left = [&](std::size_t i, double time) {
        const double y = std::min(time / times_[i], 1.0);
        return overlaps_[i] * (1.0 - y * y * (3.0 - 2.0 * y));
    };
    start_.resize(overlaps_.size());
    end_.resize(overlaps_.size());
    for (std::size_t i = 0; i < overlaps_.size(); ++i) {
        start_[i] = left(i, elapsed_);
        end_[i] = left(i, elapsed_ + dt);
    }
}

std::vector<double> InterferenceRamps::saved() const {
    std::vector<double> saved = overlaps_;
    if (has_begun()) saved.push_back(elapsed_);
    return saved;
}

void InterferenceRamps::restore(std::span<const double> saved) {
    const bool fits = saved.empty() || (any() && saved.size() == times_.size() + 1);
    if (!fits || std::ranges::any_of(saved, [](double value) { return !(value >= 0.0) || !std::isfinite(value); }))
        throw BadInput("contact: a saved state has " + std::to_string(saved.size()) + " numbers of interference for " +
                       std::to_string(times_.size()) + " times. It is of other options, or damaged.");
    overlaps_.assign(saved.begin(), saved.empty() ? saved.end() : saved.end() - 1);
    elapsed_ = saved.empty() ? 0.0 : saved.back();
}

}  // namespace abut::contact
