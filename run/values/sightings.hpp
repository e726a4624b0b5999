#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::run {

/// A body that a flat obstacle held, or would have held, and that is past its rim: nothing is below it there.
struct PastRim {
    std::string body, obstacle;  ///< their names
    double time;                 ///< of the first record at which it was seen [s]

    static auto fields(auto& self) { return std::tie(self.body, self.obstacle, self.time); }
};

/// A body two parts of whose surface have come together.
template <int Dim>
struct NearItself {
    std::string body;      ///< its name
    double time;           ///< of the first record at which it was seen [s]
    double gap;            ///< between the two faces there that are nearest, or deepest in each other [m]
    double gap_at_rest;    ///< between the same two, along the normal of one of them [m]
    Vector<Dim> position;  ///< between them, at that time [m]

    static auto fields(auto& self) { return std::tie(self.body, self.time, self.gap, self.gap_at_rest, self.position); }
};

/// A body that is not looked at any more for parts of it that come together, since a look could not be made.
struct LookEnded {
    std::string body;    ///< its name
    double time;         ///< of the record [s]
    std::string reason;  ///< the message of the error

    static auto fields(auto& self) { return std::tie(self.body, self.time, self.reason); }
};

/// Sightings of bodies at the records of a run, each body once.
template <int Dim>
struct Sightings {
    std::vector<PastRim> past_rims;
    std::vector<NearItself<Dim>> near_themselves;  ///< where contact does not look at it
    std::vector<LookEnded> looks_ended;

    static auto fields(auto& self) { return std::tie(self.past_rims, self.near_themselves, self.looks_ended); }
};

}  // namespace abut::run
