#pragma once
#include <string>

#include "abut/base/vector.hpp"

namespace abut::run {

/// A body that a flat obstacle held, or would have held, and that is past its rim: nothing is below it there.
struct PastRim {
    std::string body, obstacle;  ///< their names
    double time;                 ///< of the first record at which it was seen [s]
};

/// A body two parts of whose surface have come together.
template <int Dim>
struct NearItself {
    std::string body;      ///< its name
    double time;           ///< of the first record at which it was seen [s]
    double gap;            ///< between the two faces there that are nearest, or deepest in each other [m]
    double gap_at_rest;    ///< between the same two [m]
    Vector<Dim> position;  ///< between them, at that time [m]
};

}  // namespace abut::run
