#include "abut/contact/facet_store.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"

namespace abut::contact {

FacetStore::FacetStore(std::int32_t n_facets, std::int32_t size)
    : size_(size), now_(static_cast<std::size_t>(n_facets) * static_cast<std::size_t>(size), 0.0) {}

FacetStore FacetStore::carried_over(std::span<const std::int32_t> old_of_new) const {
    FacetStore carried(static_cast<std::int32_t>(old_of_new.size()), size_);
    for (std::size_t facet = 0; facet < old_of_new.size(); ++facet)
        if (old_of_new[facet] >= 0)
            std::ranges::copy((*this)[Facet{old_of_new[facet]}],
                              carried.now_.begin() + static_cast<std::ptrdiff_t>(carried.begin(Facet(facet))));
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
    return store;
}

}  // namespace abut::contact
