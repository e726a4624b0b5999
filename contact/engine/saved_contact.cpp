#include "abut/contact/engine/saved_contact.hpp"

#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/base/state_fields.hpp"

namespace abut::contact {
namespace {

constexpr std::uint32_t state_version = 12;

/// A new counter needs its place in `ContactReport::fields`, or it is lost where a state is saved; then a new version, too.
static_assert(sizeof(ContactReport) == 24 * sizeof(double));

void put_pairs(StateWriter& state, std::span<const FacetPair> pairs) {
    state.put(static_cast<std::uint64_t>(pairs.size()));
    for (const FacetPair& pair : pairs) {
        state.put(number_of(pair.facet_1));
        state.put(number_of(pair.facet_2));
    }
}

std::vector<FacetPair> pairs_from(StateReader& state, const StateKey& key) {
    std::vector<FacetPair> pairs;
    const auto n = state.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < n; ++i) {  // `get` refuses to read past the end, whatever n claims
        pairs.push_back({Facet{state.get<std::int32_t>()}, Facet{state.get<std::int32_t>()}});
        const auto [facet_1, facet_2] = pairs.back();
        if (number_of(facet_1) < 0 || !(facet_1 < facet_2) || number_of(facet_2) >= key.n_facets)
            throw BadInput("state of " + key.kind + ": facets " + std::to_string(number_of(facet_1)) + " and " +
                           std::to_string(number_of(facet_2)) + " of " + std::to_string(key.n_facets) +
                           " are no pair. It is damaged.");
    }
    return pairs;
}

void put_facets(StateWriter& state, std::span<const Facet> facets) {
    state.put(static_cast<std::int32_t>(facets.size()));
    for (const Facet facet : facets) state.put(number_of(facet));
}

std::vector<Facet> facets_from(StateReader& state, const StateKey& key, const std::string& which) {
    const auto n = state.get<std::int32_t>();
    if (n < 0 || n > key.n_facets)
        throw BadInput("state of " + key.kind + ": it has " + std::to_string(n) + " " + which + " facets of " +
                       std::to_string(key.n_facets) + " at most. It is damaged.");
    std::vector<Facet> facets;
    for (std::int32_t i = 0; i < n; ++i) facets.push_back(Facet{state.get<std::int32_t>()});
    return facets;
}

}  // namespace

std::vector<std::byte> saved(const StateKey& key, const SavedContact& contact) {
    StateWriter state(key.kind, state_version);
    state.put(key.fingerprint);
    state.put(static_cast<std::uint8_t>(contact.has_searched));
    state.put(contact.next_skin);
    put_value(state, contact.report);
    put_facets(state, contact.new_facets);
    put_facets(state, contact.covered);
    contact.pairs.save(state);
    contact.facets.save(state);
    put_pairs(state, contact.kept_apart);
    put_pairs(state, contact.law.seen);
    state.put(static_cast<std::uint64_t>(contact.law.interference.size()));
    for (const double value : contact.law.interference) state.put(value);
    return std::move(state).finish();
}

SavedContact read_saved(const StateKey& key, std::span<const std::byte> bytes) {
    StateReader state(bytes, key.kind, state_version);
    if (state.get<std::uint64_t>() != key.fingerprint)
        throw BadInput("state of " + key.kind +
                       ": it is of another surface. Restore it where the faces, depths and stiffnesses are the same.");
    SavedContact contact;
    contact.has_searched = state.get<std::uint8_t>() != 0;
    contact.next_skin = state.get<double>();
    get_value(state, contact.report);
    contact.new_facets = facets_from(state, key, "new");
    contact.covered = facets_from(state, key, "covered");
    contact.pairs = PairStore::restored(state, key.n_facets);
    contact.facets = FacetStore::restored(state, key.n_facets, key.facet_memory);
    contact.kept_apart = pairs_from(state, key);
    contact.law.seen = pairs_from(state, key);
    const auto n_interference = state.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < n_interference; ++i) contact.law.interference.push_back(state.get<double>());
    state.finish();
    return contact;
}

}  // namespace abut::contact
