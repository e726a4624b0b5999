#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>

#include "abut/base/large_array.hpp"
#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

/// Sweeps that compute the bulk of steps in place of those of double precision on the host, which do all else. Functions as
/// those of CcgSweeps and Ccg.
template <int Dim>
class StepSweeps {
public:
    virtual ~StepSweeps() = default;
    virtual void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                          const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) = 0;
    virtual void mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load,
                               const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) = 0;
    virtual void gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load,
                                    const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) = 0;
    virtual void compute_only(const Region<Dim>& region) = 0;

    [[nodiscard]] virtual Vector<Dim> face_gradient(BoundaryFace b) = 0;
    [[nodiscard]] virtual Matrix<Dim> displacement_gradient(std::int32_t c) = 0;
    [[nodiscard]] virtual Matrix<Dim> stress(std::int32_t c) = 0;
};

}  // namespace abut::solid
