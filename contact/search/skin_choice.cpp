#include "abut/contact/search/skin_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::contact {
namespace {

// Cost of making a list, a face and a pair of it, in units of what a pair costs in a step: docs/detection.md.
constexpr double cost_per_face = 4.0;
constexpr double cost_per_pair = 10.0;

// Bounds of the skin in mean face sizes. Beyond the upper one lists are so rare that nothing is left to gain.
constexpr double least = 0.02;
constexpr double most = 4.0;

// Of the first list, before anything is known.
constexpr double first = 0.5;

// From one list to the next the skin changes by no more than this factor: the next one knows better.
constexpr double largest_change = 2.0;

// Without any pairs a larger skin is always better, until it reaches the first: to be approached with care.
constexpr double growth_without_pairs = 1.25;

}  // namespace

SkinChoice::SkinChoice(int dim, double fixed, double face_size)
    : dim_(dim), is_fixed_(fixed > 0.0), face_size_(face_size), skin_(is_fixed_ ? fixed : first * face_size) {}

void SkinChoice::learn(std::int64_t pairs, std::int64_t pairs_at_half, std::int64_t faces, double motion) {
    if (is_fixed_ || motion == 0.0 || face_size_ == 0.0) return;
    if (pairs == 0) {
        skin_ = std::min(skin_ * growth_without_pairs, most * face_size_);
        return;
    }
    const auto root = [power = 1.0 / (dim_ - 1)](std::int64_t n) { return std::pow(static_cast<double>(n), power); };
    const double at_skin = root(pairs), at_half = root(pairs_at_half), half = 0.5 * skin_;
    const auto cost_of_step = [&](double skin) {
        const double n = std::pow(std::max(0.0, at_half + (at_skin - at_half) * (skin - half) / half), dim_ - 1);
        return 2.0 * motion / skin * (cost_per_face * static_cast<double>(faces) + cost_per_pair * n) + n;
    };
    const double lower = std::max(skin_ / largest_change, least * face_size_);
    const double upper = std::min(skin_ * largest_change, most * face_size_);
    double least_cost = std::numeric_limits<double>::infinity();
    constexpr int trials = 32;
    for (int i = 0; i <= trials; ++i) {
        const double skin = lower * std::pow(upper / lower, static_cast<double>(i) / trials);
        if (const double cost = cost_of_step(skin); cost < least_cost) {
            least_cost = cost;
            skin_ = skin;
        }
    }
}

}  // namespace abut::contact
