#pragma once
// Private to the sources of this layer.
#include <vector>

#include "abut/solid/ccg/device_kernels.hpp"
#include "abut/solid/ccg/placed_corrections.hpp"
#include "abut/solid/ccg/step_sweeps.hpp"
#include "abut/solid/ccg/sweeps.hpp"

namespace abut::solid {

/// Steps on the device of Kokkos: the sweeps of CcgSweeps<Dim>, with its bits. Displacements, corrections and loads go
/// there and gradients come back in each step; what else is asked for comes when it is.
template <int Dim>
class DeviceSweeps final : public StepSweeps<Dim> {
public:
    /// All must outlive it. Throws as DeviceKernels does.
    DeviceSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite, const CcgSweeps<Dim>& sweeps);

    void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                  std::span<Vector<Dim>> result) override;
    void mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                       std::span<Vector<Dim>> result) override;
    void gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                            std::span<Vector<Dim>> result) override;
    /// All cells are computed all the same.
    void compute_only(const Region<Dim>&) override {}

    [[nodiscard]] Vector<Dim> face_gradient(BoundaryFace b) override;
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t c) override;
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) override;

private:
    using Vectors = Lanes<Dim>;

    template <class LoadCell>
    void run(const LoadCell& load_cell, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
             std::span<Vector<Dim>> result);
    [[nodiscard]] LaneTensor<Dim> present_gradient(std::int32_t c);

    const CcgArrays<Dim>& arrays_;
    const FiniteCells<Dim>& finite_;
    DeviceKernels<Dim> kernels_;
    CellMoments<Dim> moments_;
    std::vector<std::int32_t> moment_cells_;
    LargeArray<double> moment_stresses_;
    // Of the last step, here once somebody has asked for it.
    LargeArray<double> boundary_y_, of_face_, g_;
    SweepElements<Vectors> element_;  // of these
    bool has_boundary_y_ = false, has_state_ = false;
};

}  // namespace abut::solid
