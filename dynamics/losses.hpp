#pragma once
#include <array>

namespace abut::dynamics {

/// Energy that was dissipated, by kind, in a step or in all so far [J].
struct Losses {
    double by_friction = 0.0;   ///< by faces that slide: >= 0
    double in_cells = 0.0;      ///< by inelastic materials as they flow: >= 0
    double in_jumps = 0.0;      ///< by jumps between cells that reach their cap: >= 0
    double on_faces = 0.0;      ///< what free faces take out of jumps and contact as they flow along: small, without a sign
    double by_damping = 0.0;    ///< Rayleigh's: >= 0
    double by_viscosity = 0.0;  ///< of shocks: >= 0
    double lagged = 0.0;  ///< what damping has taken and may give back in the next step, as it acts on the mean of two rates
    double in_bonds = 0.0;   ///< what bonds lost as they opened or broke: >= 0
    double at_splits = 0.0;  ///< by frames of fragments, and as contact takes over at a break: small, without a sign

    [[nodiscard]] double total() const;
    Losses& operator+=(const Losses& other);
};

/// A kind, and the name of its column in a ledger.
struct Loss {
    const char* name;
    double Losses::*of;
};

/// All of them: ledgers, their columns and their units come from here.
inline constexpr std::array all_losses{Loss{"dissipated_by_friction", &Losses::by_friction},
                                       Loss{"dissipated_in_cells", &Losses::in_cells},
                                       Loss{"dissipated_in_jumps", &Losses::in_jumps},
                                       Loss{"dissipated_on_faces", &Losses::on_faces},
                                       Loss{"dissipated_by_damping", &Losses::by_damping},
                                       Loss{"dissipated_by_viscosity", &Losses::by_viscosity},
                                       Loss{"damping_lagged", &Losses::lagged},
                                       Loss{"dissipated_in_bonds", &Losses::in_bonds},
                                       Loss{"dissipated_at_splits", &Losses::at_splits}};

inline double Losses::total() const {
    double sum = 0.0;
    for (const Loss& loss : all_losses) sum += this->*loss.of;
    return sum;
}

inline Losses& Losses::operator+=(const Losses& other) {
    for (const Loss& loss : all_losses) this->*loss.of += other.*loss.of;
    return *this;
}

}  // namespace abut::dynamics
