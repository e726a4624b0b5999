#include "apps/support/time_left.hpp"

#include <fmt/format.h>

#include <cmath>

namespace abut::apps {
namespace {

/// Part of the time so far, between two marks.
constexpr double part_between_marks = 0.01;

}  // namespace

void TimeLeft::add(std::int64_t step, double elapsed) {
    const auto is_near = [&](const Mark& before) { return elapsed - before.elapsed < part_between_marks * elapsed; };
    if (marks_.size() >= 2 && is_near(marks_[marks_.size() - 2])) marks_.pop_back();
    marks_.push_back({step, elapsed});
    while (marks_.size() > 2 && marks_[1].elapsed <= 0.5 * elapsed) marks_.pop_front();
}

double TimeLeft::seconds() const {
    const Mark &first = marks_.front(), &last = marks_.back();
    if (last.step == first.step) return 0.0;
    return (last.elapsed - first.elapsed) / static_cast<double>(last.step - first.step) *
           static_cast<double>(n_steps_ - last.step);
}

std::string duration(double seconds) {
    if (seconds < 99.95) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 6000) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    if (whole < 48 * 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
    return fmt::format("{} d {:02} h", whole / 86400, whole / 3600 % 24);
}

}  // namespace abut::apps
