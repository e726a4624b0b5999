#include <catch2/catch.hpp>

#include "abut/contact/overlap/face_distance.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("the distance of two faces is that of their nearest points, whatever their gap says",
                       "[contact][overlaps]", ((int Dim), Dim), 2, 3) {
    // A tile lies flat, another is tilted about its lowest corner or edge, which is above or below a place near the end of the first.
    const double angle = GENERATE(0.0, 0.3, 0.8), height = GENERATE(0.1, -0.05);
    const Vector<Dim> along = std::cos(angle) * axis<Dim>(0) + std::sin(angle) * up<Dim>();
    const Vector<Dim> lowest = 0.4 * axis<Dim>(0) + height * up<Dim>(), half = 0.5 * axis<Dim>(0);
    contact::Surface<Dim> surface;
    if constexpr (Dim == 2) {
        surface.append(std::vector<Vector<2>>{half, -half}, 0.1, 1.0, 0);
        surface.append(std::vector<Vector<2>>{lowest, lowest + along}, 0.1, 1.0, 1);
    } else {
        const Vector<3> y = 0.5 * axis<3>(1);
        surface.append(std::vector<Vector<3>>{half - y, half + y, y - half, -half - y}, 0.1, 1.0, 0);
        surface.append(std::vector<Vector<3>>{lowest - y, lowest + y, lowest + along + y, lowest + along - y}, 0.1, 1.0, 1);
    }
    const std::vector<Vector<Dim>> none(2, Vector<Dim>::Zero());
    const std::vector<geometry::IndexPair> pairs{{0, 1}};
    const auto overlaps = contact::find_overlaps<Dim>(surface.view(), none, pairs);
    const auto distances = contact::face_distances<Dim>(surface.view(), surface.vertices, overlaps.found);
    REQUIRE(overlaps.found.size() == 1);
    REQUIRE(distances.size() == 1);
    // Below the first tile: its end is above the second one by 0.1 tan(angle) - 0.05, or they cross.
    const double end = (0.1 * along.dot(up<Dim>()) / along[0] + height) * std::cos(angle);
    const double expected = height > 0.0 ? height : std::max(0.0, -end);
    CHECK(distances[0] == Approx(expected).margin(2e-6));
}
