#include <catch2/catch.hpp>

#include "abut/base/error.hpp"
#include "abut/solid/ccg/step_device.hpp"

using namespace abut;

TEST_CASE("without Kokkos steps on a device are refused, and the package to install is named", "[solid][device]") {
    CHECK_THROWS_AS(solid::kokkos_device(), BadInput);
    CHECK_THROWS_WITH(solid::kokkos_device(), Catch::Contains("this build of Abut has no Kokkos") &&
                                                  Catch::Contains("--device host") &&
                                                  Catch::Contains("libtrilinos-kokkos-dev"));
}
