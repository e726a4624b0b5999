#pragma once
// Private to the layer.
#include <cstdint>

namespace abut::contact {

/// The skin that costs least. A list with the skin s lives for s/(2 v) steps when faces move by v per step, and holds N(s)
/// pairs. To make it costs f per face and p per pair, in units of the cost of a pair in a step. Then n faces cost per step
///
///     2 v/s (f n + p N(s)) + N(s).
///
/// Around a face lie as many others as fit into its interaction radius: N is taken for the power Dim - 1 of a linear
/// function, given by the numbers of pairs with the last skin and with half of it. These and v are counted at each search:
/// no clock takes part, so that a run gives the same lists every time.
class SkinChoice {
public:
    /// `fixed` > 0: always that [m]. `face_size`: the mean size of the faces [m]; the choice begins with half of it.
    SkinChoice(int dim, double fixed, double face_size);

    [[nodiscard]] double skin() const { return skin_; }
    /// Goes on from a skin that another choice had come to [m]; a fixed one stays.
    void restore(double skin) {
        if (!is_fixed_) skin_ = skin;
    }
    /// Figures of the last list: pairs with this skin and with half of it, faces, and the largest motion of a face in a
    /// step [m].
    void learn(std::int64_t pairs, std::int64_t pairs_at_half, std::int64_t faces, double motion);

private:
    int dim_;
    bool is_fixed_;
    double face_size_;
    double skin_;
};

}  // namespace abut::contact
