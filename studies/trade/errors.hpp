#pragma once
#include <array>
#include <string>

#include "apps/support/run_options.hpp"
#include "studies/table/figures.hpp"

namespace abut::studies::trade {

/// Figures of a run and how far it is from what it should be, without units; NaN: the problem does not ask for it.
/// `drift` and `energy_drift`, of the true energy, are errors, too; `parasitic` is over the speed of impact, momenta
/// are of bodies that nothing holds.
struct Outcome : Figures {
    double restitution = run::not_given;  ///< of the speed of separation over that of approach
    double velocity = run::not_given;     ///< of the left body at the end, over the speed of impact
    double pressure = run::not_given;     ///< of the contact pressure, relative in L2
};

/// One of the errors, for tables and pictures.
struct Measure {
    std::string key;    ///< column of the files
    std::string label;  ///< on an axis
    double Outcome::*error;
};
inline const std::array<Measure, 5> measures = {{{"drift", "drift of H~ / scale", &Outcome::drift},
                                                 {"energy", "error of H / scale", &Outcome::energy_drift},
                                                 {"restitution", "error of restitution", &Outcome::restitution},
                                                 {"velocity", "error of velocity / speed", &Outcome::velocity},
                                                 {"pressure", "error of pressure, L2", &Outcome::pressure}}};

}  // namespace abut::studies::trade
