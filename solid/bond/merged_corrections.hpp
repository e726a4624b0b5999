#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

/// Two sets of corrections in one.
template <int Dim>
class MergedCorrections {
public:
    /// Their sum, face by face. Valid until the next call and as long as both are.
    [[nodiscard]] FaceCorrections<Dim> of(const FaceCorrections<Dim>& first, const FaceCorrections<Dim>& second) {
        if (first.faces.empty()) return second;
        if (second.faces.empty()) return first;
        faces_.clear();
        std::ranges::set_union(first.faces, second.faces, std::back_inserter(faces_));
        displacement_.assign(faces_.size(), Vector<Dim>::Zero());
        gradient_.assign(faces_.size(), Vector<Dim>::Zero());
        moment_.assign(faces_.size(), Matrix<Dim>::Zero());
        add(first);
        add(second);
        return {faces_, displacement_, gradient_, moment_};
    }

private:
    void add(const FaceCorrections<Dim>& part) {
        std::size_t at = 0;
        for (std::size_t i = 0; i < part.faces.size(); ++i) {
            while (faces_[at] < part.faces[i]) ++at;
            if (!part.displacement.empty()) displacement_[at] += part.displacement[i];
            if (!part.energy_gradient.empty()) gradient_[at] += part.energy_gradient[i];
            if (!part.moment.empty()) moment_[at] += part.moment[i];
        }
    }

    std::vector<BoundaryFace> faces_;
    std::vector<Vector<Dim>> displacement_, gradient_;
    std::vector<Matrix<Dim>> moment_;
};

}  // namespace abut::solid
