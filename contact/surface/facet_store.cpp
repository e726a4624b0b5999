#include "abut/contact/surface/facet_store.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"

namespace abut::contact {

FacetStore::FacetStore(std::int32_t n_facets, std::int32_t size)
    : size_(size), now_(static_cast<std::size_t>(n_facets) * static_cast<std::size_t>(size), 0.0) {}

void FacetStore::begin_step() {
    written_.clear();
    next_.clear();
}

void FacetStore::set_next(Facet facet, std::span<const double> memory) {
    written_.push_back(facet);
    next_.insert(next_.end(), memory.begin(), memory.end());
}

void FacetStore::end_step() {
    const auto n_used = std::ssize(used_);
    for (std::size_t i = 0; i < written_.size(); ++i) {
        const auto from = next_.begin() + static_cast<std::ptrdiff_t>(i) * size_;
        std::copy(from, from + size_, now_.begin() + static_cast<std::ptrdiff_t>(begin(written_[i])));
        if (!std::binary_search(used_.begin(), used_.begin() + n_used, written_[i])) used_.push_back(written_[i]);
    }
    if (std::ssize(used_) > n_used) std::ranges::sort(used_);
    written_.clear();
}

void FacetStore::find_used() {
    used_.clear();
    if (size_ == 0) return;
    for (std::size_t facet = 0; facet < now_.size() / static_cast<std::size_t>(size_); ++facet)
        if (std::ranges::any_of((*this)[Facet(facet)], [](double value) { return value != 0.0; }))
            used_.push_back(Facet(facet));
}

FacetStore FacetStore::carried_over(std::span<const std::int32_t> old_of_new) const {
    FacetStore carried(static_cast<std::int32_t>(old_of_new.size()), size_);
    for (std::size_t facet = 0; facet < old_of_new.size(); ++facet)
        if (old_of_new[facet] >= 0)
            std::ranges::copy((*this)[Facet{old_of_new[facet]}],
                              carried.now_.begin() + static_cast<std::ptrdiff_t>(carried.begin(Facet(facet))));
    carried.find_used();
    return carried;
}

void FacetStore::save(StateWriter& state) const {
    state.put(size_);
    state.put_all(std::span<const double>(now_));
}

FacetStore FacetStore::restored(StateReader& state, std::int32_t n_facets, std::int32_t size) {
    FacetStore store(n_facets, size);
    const auto saved_size = state.get<std::int32_t>();
    const auto values = state.get_all<double>();
    if (saved_size != size)
        throw BadInput("facet store: " + std::to_string(saved_size) + " numbers per facet are saved, but the law has " +
                           std::to_string(size) + ". Restore the state under the law that it is of.",
                       {.value = static_cast<double>(saved_size), .allowed = static_cast<double>(size)});
    if (values.size() != store.now_.size())
        throw BadInput("facet store: " + std::to_string(values.size()) + " numbers are saved for " +
                           std::to_string(n_facets) + " facets with " + std::to_string(size) + " each. It is damaged.",
                       {.value = static_cast<double>(values.size()), .allowed = static_cast<double>(store.now_.size())});
    if (const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
        bad != values.end())
        throw BadInput("facet store: number " + std::to_string(bad - values.begin()) +
                       " of a saved state is not finite. It is damaged.");
    store.now_ = values;
    store.find_used();
    return store;
}

}  // namespace abut::contact
