#pragma once
// The law of contact on a given list of pairs, without a search.
#include <vector>

#include "abut/contact/law/reconstruction.hpp"
#include "abut/contact/path/measures.hpp"
#include "abut/contact/path/pieces.hpp"

namespace abut::test {

template <int Dim>
class LawOnList {
public:
    explicit LawOnList(const contact::ContactOptions& options) : pieces_(options), law_(options) {}

    /// `list` numbers its faces by their places in `faces`.
    const contact::ContactStep<Dim>& operator()(const contact::SurfaceView<Dim>& surface, const contact::PairList<Dim>& list,
                                                const std::vector<contact::PairMemory>& memory,
                                                const std::vector<contact::Face>& faces,
                                                const contact::FaceCoupling<Dim>& coupling,
                                                const contact::FacePath<Dim>& path,
                                                contact::Cuts cuts = contact::Cuts::coupled) {
        const auto& active = pieces_.find(surface, list, memory, path.displacement_0, path.displacement_1);
        step_.faces = faces;
        measures_.fill(surface, list, active, step_);
        law_.apply(surface, list, active, coupling, path, step_, cuts);
        return step_;
    }

private:
    contact::PieceFinder<Dim> pieces_;
    contact::PathMeasures<Dim> measures_;
    contact::Reconstruction<Dim> law_;
    contact::ContactStep<Dim> step_;
};

}  // namespace abut::test
