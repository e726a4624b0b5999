#pragma once
#include <cstddef>
#include <span>

#include "abut/solid/boundary/bond_places.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// Bonds of a solid as they are now (Solid::bonds). It is of use as long as the solid lives.
template <int Dim>
class BondView {
public:
    explicit BondView(const Solid<Dim>& solid) : solid_(solid) {}

    /// Places where faces are bonded, whether they still are or not; empty without bonds.
    [[nodiscard]] std::span<const BondPlace<Dim>> places() const;
    /// How much of each of SolidOptions::bonds is bonded (n_bonds).
    [[nodiscard]] std::span<const BondCoverage> coverage() const;
    [[nodiscard]] bool may_break() const;  ///< whether one has a strength
    /// Whether it bears nothing any more: contact has its faces.
    [[nodiscard]] bool is_broken(std::size_t place) const;
    /// Share of the pull of a place that is left at the same jump [-]: 1 whole, 0 broken.
    [[nodiscard]] double share(std::size_t place) const;
    /// Share of the area of all bonds that is broken [-]; 0 without bonds.
    [[nodiscard]] double broken_share() const;
    /// Energy that places with a fracture energy have dissipated beyond what they should for how far they are open [J]; less
    /// than 0 where they have dissipated less.
    [[nodiscard]] double beyond_fracture_energy() const;

private:
    const Solid<Dim>& solid_;
};

}  // namespace abut::solid
