#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Memory of facets from step to step: so many numbers of each as the law wants, 0 at the start, whether or not the
/// facet is in a list. A law without memory of facets has a store without numbers, which costs neither time nor space.
///
/// A law reads where the last step ended, and writes where this one ends; a step that is refused leaves the memory as
/// it was. A step costs as much as the facets that have been in use.
class FacetStore {
public:
    FacetStore() = default;
    /// `size`: numbers per facet.
    FacetStore(std::int32_t n_facets, std::int32_t size);

    [[nodiscard]] std::int32_t size() const { return size_; }  ///< numbers per facet
    /// Memory where the last step ended.
    [[nodiscard]] std::span<const double> operator[](Facet facet) const {
        return {now_.data() + begin(facet), static_cast<std::size_t>(size_)};
    }
    /// Facets whose memory may differ from 0, increasing.
    [[nodiscard]] std::span<const Facet> used() const { return used_; }

    void begin_step();
    /// Memory where the present step ends, `size` numbers: that of facets without stays as it is. At most once per facet and
    /// step.
    void set_next(Facet facet, std::span<const double> memory);
    void end_step();

    /// Memory of facets that have got other numbers. `old_of_new`: the old number of each, -1 for a facet that was not
    /// there, which remembers nothing.
    [[nodiscard]] FacetStore carried_over(std::span<const std::int32_t> old_of_new) const;

    void save(StateWriter& state) const;
    /// Throws BadInput unless what is read has `size` finite numbers of each of `n_facets` facets.
    [[nodiscard]] static FacetStore restored(StateReader& state, std::int32_t n_facets, std::int32_t size);

private:
    void find_used();
    [[nodiscard]] std::size_t begin(Facet facet) const {
        return static_cast<std::size_t>(facet) * static_cast<std::size_t>(size_);
    }

    std::int32_t size_ = 0;
    std::vector<double> now_;  // of each facet
    std::vector<Facet> used_;
    std::vector<Facet> written_;  // in this step
    std::vector<double> next_;    // of these
};

}  // namespace abut::contact
