#pragma once
#include <algorithm>
#include <cmath>
#include <tuple>

#include "abut/base/vector.hpp"
#include "abut/dynamics/ledger.hpp"

namespace abut::run {

/// Energy and momentum that a run had so far, by its records: scales for its errors.
template <int Dim>
struct Accounts {
    /// The largest of the kinetic energy at the start, |work|, H~0 + work, what of that is not in V, as in a fall, and
    /// -V [J]. Energy that came from nowhere, H - H~, is no part of it.
    double energy_in_play = 0.0;
    double speed = 0.0;  ///< largest |p_i| / m_i [m/s]
    /// max |P - P0 - I| [kg m/s], P with that of cells that have left, I being what gravity and contact with obstacles
    /// have given
    double momentum_drift = 0.0;

    /// `speed_now` of this entry [m/s]; `given`: I until then.
    void record(const dynamics::LedgerEntry<Dim>& entry, double speed_now, const Vector<Dim>& given) {
        if (is_first) {
            first_energy = entry.pseudo_energy - entry.received();
            first_momentum = entry.linear_momentum - given;
            energy_in_play = entry.kinetic;
            is_first = false;
        }
        const double to_share = first_energy + entry.received() + entry.dissipated;
        for (const double energy : {std::abs(entry.work), to_share, to_share - entry.potential, -entry.potential})
            energy_in_play = std::max(energy_in_play, energy);
        speed = std::max(speed, speed_now);
        momentum_drift =
            std::max(momentum_drift, (entry.linear_momentum + entry.eroded.momentum - given - first_momentum).norm());
    }

    /// Memory of a checkpoint.
    static auto fields(auto& self) {
        return std::tie(self.energy_in_play, self.speed, self.momentum_drift, self.first_energy, self.first_momentum,
                        self.is_first);
    }

private:
    double first_energy = 0.0;  // H~0 less work [J]
    Vector<Dim> first_momentum = Vector<Dim>::Zero();
    bool is_first = true;
};

}  // namespace abut::run
