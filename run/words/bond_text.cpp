#include "abut/run/words/bond_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abut::run {

template <int Dim>
std::string bonded_text(std::span<const solid::BondCoverage> bonds) {
    if (bonds.empty()) return "";
    double share = 1.0, of_side = 1.0, opposite = 0.0, gap = 0.0;
    for (const solid::BondCoverage& bond : bonds) {
        share = std::min(share, bond.share());
        of_side = std::min(of_side, bond.share_of_side());
        opposite += bond.opposite;
        gap = std::max(gap, bond.largest_gap);
    }
    return fmt::format("{:.3g} of {:.4g} {}, {:.3g} of the smaller side, largest gap {:.2g} m{}", share, opposite,
                       Dim == 2 ? "m" : "m^2", of_side, gap,
                       bonds.size() > 1 ? fmt::format("; the least of {} bonds", bonds.size()) : "");
}

template std::string bonded_text<2>(std::span<const solid::BondCoverage>);
template std::string bonded_text<3>(std::span<const solid::BondCoverage>);

}  // namespace abut::run
