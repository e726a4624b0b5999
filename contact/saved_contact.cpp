#include "abut/contact/saved_contact.hpp"

#include <string>
#include <type_traits>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/contact/report_counters.hpp"

namespace abut::contact {
namespace {

/// A new counter needs its line in `for_each_counter`, or it is lost where a state is saved; then a new version, too.
static_assert(sizeof(ContactReport) == 15 * sizeof(double));

}  // namespace

std::vector<std::byte> saved(const StateKey& key, const SavedContact& contact) {
    StateWriter state(key.kind, key.version);
    state.put(key.fingerprint);
    state.put(static_cast<std::uint8_t>(contact.has_searched));
    state.put(contact.next_skin);
    for_each_counter(contact.report, [&](const auto& counter) { state.put(counter); });
    state.put(static_cast<std::int32_t>(contact.new_faces.size()));
    for (const std::int32_t face : contact.new_faces) state.put(face);
    contact.store.save(state);
    return std::move(state).finish();
}

SavedContact read_saved(const StateKey& key, std::span<const std::byte> bytes) {
    StateReader state(bytes, key.kind, key.version);
    if (state.get<std::uint64_t>() != key.fingerprint)
        throw BadInput("state of " + key.kind +
                       ": it is of another surface. Restore it where the faces, depths and stiffnesses are the same.");
    SavedContact contact;
    contact.has_searched = state.get<std::uint8_t>() != 0;
    contact.next_skin = state.get<double>();
    for_each_counter(contact.report,
                     [&](auto& counter) { counter = state.get<std::remove_reference_t<decltype(counter)>>(); });
    const auto n_new = state.get<std::int32_t>();
    if (n_new < 0 || n_new > key.n_faces)
        throw BadInput("state of " + key.kind + ": it has " + std::to_string(n_new) + " new faces of " +
                       std::to_string(key.n_faces) + " at most. It is damaged.");
    for (std::int32_t i = 0; i < n_new; ++i) contact.new_faces.push_back(state.get<std::int32_t>());
    contact.store = PairStore::restored(state, key.n_faces);
    state.finish();
    return contact;
}

}  // namespace abut::contact
