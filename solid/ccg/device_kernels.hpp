#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <memory>
#include <span>

#include "abut/solid/ccg/step_device.hpp"
#include "abut/solid/cells/sweep_tables.hpp"

namespace abut::solid {

/// The five sweeps on the device of Kokkos. What the device needs in each step is written to memory of the host from which
/// copies are fast, and what it gives is read from there.
template <int Dim>
class DeviceKernels {
public:
    /// Copies what tables of the host hold of the mesh to the device. Throws BadInput where Abut was built without
    /// Kokkos or the machine has no such device, MemoryError where the device has too little memory.
    explicit DeviceKernels(const SweepTables<Dim, double>& host);
    ~DeviceKernels();
    DeviceKernels(const DeviceKernels&) = delete;
    DeviceKernels& operator=(const DeviceKernels&) = delete;

    /// u, correction and pair_gradient of the next step, on the host; corrections are zero but where somebody has set them.
    [[nodiscard]] const SweepTables<Dim, double>& staged() const;

    /// Stresses added to S_c of some cells, increasing.
    struct Moments {
        std::span<const std::int32_t> cells;
        std::span<const double> stresses;  // packed tensors
    };
    /// dV/du_c (n_cells, Dim) [N] of what is staged and these loads (SweepTables); valid until the next call.
    /// `with_corrections`: they are not all zero.
    [[nodiscard]] std::span<const double> gradient(Table<const double> load_displacement, Table<const double> traction,
                                                   bool with_corrections, const Moments& moments);

    // Of the last call, packed: into memory of the host.
    void fetch_boundary_y(std::span<double> into) const;
    void fetch_of_face(std::span<double> into) const;
    void fetch_g(std::span<double> into) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace abut::solid
