#pragma once
// Private to the sources of this layer.
#include "abut/solid/ccg/step_sweeps.hpp"
#include "abut/solid/ccg/sweeps.hpp"

namespace abut::solid {

/// Steps in single precision: Precision.
template <int Dim>
class SingleSweeps final : public StepSweeps<Dim> {
public:
    /// Both must outlive it.
    SingleSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite)
        : coefficients_(in_single_precision(arrays)), sweeps_(arrays, coefficients_, finite) {}

    void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                  std::span<Vector<Dim>> result) override {
        sweeps_.gradient(u, load, corrections, result);
    }
    void mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                       std::span<Vector<Dim>> result) override {
        sweeps_.mean_gradient(ends, load, corrections, result);
    }
    void gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                            std::span<Vector<Dim>> result) override {
        sweeps_.gradient_of_packed(u, load, corrections, result);
    }
    void compute_only(const Region<Dim>& region) override { sweeps_.compute_only(region); }

    [[nodiscard]] Vector<Dim> face_gradient(BoundaryFace b) override { return sweeps_.face_gradient(b); }
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t c) override { return sweeps_.displacement_gradient(c); }
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) override { return sweeps_.stress(c); }

private:
    CcgCoefficients<Dim, float> coefficients_;
    CcgSweeps<Dim, float> sweeps_;
};

}  // namespace abut::solid
