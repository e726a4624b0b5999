#pragma once
// Private to the layer.
#include <vector>

#include "abut/contact/path/pieces.hpp"

namespace abut::contact {

/// Measures of the active pairs of a step, whatever the law that acts between them: everything of a PairStep that is
/// geometry, and the figures of the step as a whole. An instance keeps its work arrays.
template <int Dim>
class PathMeasures {
public:
    /// Fills `step.pairs` (forces are zero) and `step.report`; step.faces is the list of faces.
    void fill(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
              ContactStep<Dim>& step);

private:
    struct Slipped {
        std::int32_t active;
        double compression;
    };
    void discard_supported(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                           std::size_t n_faces);

    std::vector<Slipped> slipped_;
    std::vector<char> supported_;  // whether a listed face has a partner at the end of the step
};

}  // namespace abut::contact
