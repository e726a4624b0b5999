#pragma once
#include <memory>
#include <string>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "support/detection_scenes.hpp"

namespace abut::benchmark {

using Pairs = std::vector<geometry::IndexPair>;

/// One way to find the pairs of triangles of two bodies that come as near as `distance` to each other. It may find more.
class Finder {
public:
    virtual ~Finder() = default;
    /// From nothing: whatever it builds is part of the query.
    [[nodiscard]] virtual Pairs find(const Body& body_1, const Body& body_2, double distance) = 0;
    /// The bodies have moved a little since the last call: keeps what it can. Returns the number of pairs it has.
    [[nodiscard]] virtual std::size_t follow(const Body& body_1, const Body& body_2, double distance) {
        return find(body_1, body_2, distance).size();
    }
};

struct Rival {
    std::string name;
    std::string what;  ///< how it is used
    std::unique_ptr<Finder> (*make)();
};

/// What Debian ships, used as its documentation shows.
[[nodiscard]] const std::vector<Rival>& rivals();

/// Distance of two triangles (FCL's) [m].
[[nodiscard]] double triangle_distance(const std::array<Vector<3>, 3>& a, const std::array<Vector<3>, 3>& b);

}  // namespace abut::benchmark
