#pragma once
#include <string>

namespace abut::solid {

/// Device that computes the bulk of a step. Results are bitwise identical. docs/devices.md.
enum class StepDevice {
    host,
    kokkos,  ///< on the device that Kokkos was built for (CUDA; Serial of Debian's package is the host); linear elasticity,
             ///< double precision, one rank
};

/// The name of the device of Kokkos: "Cuda", "Serial". Throws BadInput where Abut was built without Kokkos.
[[nodiscard]] std::string kokkos_device();

}  // namespace abut::solid
