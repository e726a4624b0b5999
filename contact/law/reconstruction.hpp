#pragma once
// Private to the layer.
#include <cstdint>
#include <utility>
#include <vector>

#include "abut/contact/path/pieces.hpp"
#include "abut/contact/shared_work.hpp"

namespace abut::contact {

/// Events at which a pair force is cut into subintervals.
enum class Cuts {
    coupled,  ///< at the events of all pairs that its gradients depend on: exact, and local
    global,   ///< at the events of all pairs of the scene: the reference that `coupled` is tested against
};

/// The law of the modified reconstruction: corrections and energy gradients of the listed faces, integrated along one
/// straight step, exactly: each pair force is cut where the formula of any pair coupled to it changes. docs/method.md,
/// Contact and Time.
///
/// An instance keeps its work arrays from step to step; after a few steps it allocates nothing. Parts that share
/// contact find the gradients of as many active pairs each, and all of them all sums by face.
template <int Dim>
class Reconstruction {
public:
    explicit Reconstruction(const ContactOptions& options, Sharing* sharing = nullptr);

    /// Fills the arrays by face, the energy, and the forces of `step.pairs`, which are those of `active` in the same order.
    void apply(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
               const FaceCoupling<Dim>& coupling, const FacePath<Dim>& path, ContactStep<Dim>& step,
               Cuts cuts = Cuts::coupled);

private:
    struct Term {             // one active pair on a face
        std::int32_t active;  // index into the active pairs
        double weight;        // delta_f += weight h n_12, h = A min(g, 0)
    };
    struct Scratch {
        std::vector<std::pair<std::int32_t, double>> coupled;  // (active pair, what its h adds to beta)
        std::vector<double> nodes;
    };
    struct PairGradient {
        double normal;         // mean of beta A
        Vector<Dim> gradient;  // mean of beta (A n + g dA/ds): what dV/dû_f2 gets
    };
    /// Data that stays the same while one step is integrated.
    struct Step {
        const SurfaceView<Dim>& surface;
        const PairList<Dim>& list;
        const ActivePairs<Dim>& active;
        const FaceCoupling<Dim>& coupling;
        const FacePath<Dim>& path;
        Cuts cuts;

        [[nodiscard]] const ContactPair<Dim>& pair(std::int32_t a) const {
            return list[active.pairs[static_cast<std::size_t>(a)]];
        }
    };

    void link_faces(const Step& step);
    void add_mean_corrections(const Step& step, std::span<Vector<Dim>> mean_correction);
    [[nodiscard]] double energy_at_end(const Step& step);
    void find_pair_gradients(const Step& step);
    [[nodiscard]] PairGradient pair_gradient(const Step& step, std::int32_t a, Scratch& scratch) const;
    void collect_coupled(const Step& step, std::int32_t a, Scratch& scratch) const;
    void collect_cuts(const Step& step, double begin, double end, Scratch& scratch) const;

    int quadrature_;
    SharedWork shared_;
    std::vector<std::int32_t> term_offsets_;  // (n + 1)
    std::vector<Term> terms_;
    std::vector<double> mean_measure_;          // mean of h, by active pair
    std::vector<PairGradient> pair_gradients_;  // by active pair
    std::vector<Scratch> scratch_;              // by run of active pairs
    std::vector<Vector<Dim>> end_correction_;   // delta_f at the end of the step (n)
};

}  // namespace abut::contact
