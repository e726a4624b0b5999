#include "apps/support/warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

namespace abut::examples {
namespace {

/// Ratio of the forces of sliding and pressing from which on contacts were seen to be stiffer than the stable step allows
/// for. docs/limits.md.
constexpr double stiff_sliding = 1.0;
/// |g|/D from which on faces that slide off each other are worth a word: two coarse discs part with up to 0.2.
constexpr double deep_slip = 0.3;

std::string prefix(const std::string& run) { return run.empty() ? "" : run + ": "; }

}  // namespace

template <int Dim>
void warn_of_corners(const RunResult<Dim>& result) {
    const auto& corners = result.blind_corners;
    if (corners.empty()) return;
    spdlog::warn(
        "{} corners, one of them at ({:g}), are so sharp that contact does not see them meet a flat face: bodies pass "
        "through each other there. Blunt them, or take a --facing-cosine nearer to 0.",
        corners.size(), fmt::join(corners.front(), ", "));
}

template <int Dim>
void warn_of_compression(const RunResult<Dim>& result, const std::string& run) {
    const contact::ContactReport& contact = result.contact;
    if (contact.compressed_steps > 0)
        spdlog::warn("{}strongly compressed in {} of {:.0f} steps, at most {:.2g} of D, the depth of their cells",
                     prefix(run), contact.compressed_steps, static_cast<double>(result.steps) * result.dt / result.finest_dt,
                     contact.compression_max);
}

template <int Dim>
void warn_of_contact(const RunResult<Dim>& result, const std::string& run) {
    const contact::ContactReport& contact = result.contact;
    if (contact.sliding_ratio_max > stiff_sliding)
        spdlog::warn(
            "{}faces are pressed into each other deeper than they are wide ({:.2g} of the width where they slide off each "
            "other, {:g} is safe): contact is stiffer than the stable step allows for. Look at H - H~ and |e|/m; a lower "
            "--cfl, --filter neutral, or faces as wide as their cells are deep make it better",
            prefix(run), contact.sliding_ratio_max, stiff_sliding);
    if (contact.slipped_compression_max > deep_slip)
        spdlog::warn(
            "{}{} pairs of faces slid off each other while pressed in, by up to {:.2g} of D, the depth of their cells. At a "
            "free edge that is as it should be; elsewhere bodies pass through each other. A lower speed prevents it, and so "
            "does --overlap frozen, under which H~ drifts",
            prefix(run), contact.slipped_pairs, contact.slipped_compression_max);
    if (contact.lost_contacts > 0)
        spdlog::warn("{}{} contacts were lost, 0 are allowed: the energy is not exact", prefix(run), contact.lost_contacts);
}

template void warn_of_corners<2>(const RunResult<2>&);
template void warn_of_corners<3>(const RunResult<3>&);
template void warn_of_compression<2>(const RunResult<2>&, const std::string&);
template void warn_of_compression<3>(const RunResult<3>&, const std::string&);
template void warn_of_contact<2>(const RunResult<2>&, const std::string&);
template void warn_of_contact<3>(const RunResult<3>&, const std::string&);

}  // namespace abut::examples
