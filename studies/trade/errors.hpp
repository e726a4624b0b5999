#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "apps/support/run_options.hpp"

namespace abut::studies::trade {

/// How far a run is from what it should be, without units; NaN: the problem does not ask for it.
struct Errors {
    double drift = run::not_given;        ///< max |H~ - H~0| over the energy scale
    double energy = run::not_given;       ///< max |H - H0| over the energy scale: the true energy
    double restitution = run::not_given;  ///< of the speed of separation over that of approach
    double velocity = run::not_given;     ///< of the left body at the end, over the speed of impact
    double pressure = run::not_given;     ///< of the contact pressure, relative in L2
};

/// One of them, for tables and pictures.
struct Measure {
    std::string key;    ///< column of the files
    std::string label;  ///< on an axis
    double Errors::*error;
};
inline const std::array<Measure, 5> measures = {{{"drift", "drift of H~ / scale", &Errors::drift},
                                                 {"energy", "error of H / scale", &Errors::energy},
                                                 {"restitution", "error of restitution", &Errors::restitution},
                                                 {"velocity", "error of velocity / speed", &Errors::velocity},
                                                 {"pressure", "error of pressure, L2", &Errors::pressure}}};

/// What a run gave and what it took.
struct Outcome {
    Errors errors;
    double excess = run::not_given;          ///< max (H - H~) over the energy scale
    double parasitic = run::not_given;       ///< max |e|/m over the speed of impact
    double momentum = run::not_given;        ///< drift over sum |p| at the start, of bodies that nothing holds
    double pseudo_angular = run::not_given;  ///< of J~, over sum |x × p| at the start, of the same
    std::int64_t events = 0;
    std::int64_t missed_contacts = 0;
    std::int64_t cells = 0;
    std::int64_t steps = 0;  ///< in time, or of the static solver
    double seconds = 0.0;    ///< of the steps, without set-up and without what measures energies
};

}  // namespace abut::studies::trade
