#pragma once
// Private to the C layer.
#include <atomic>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>

#include "abut/contact/nodal_contact.hpp"
#include "guarded.hpp"
#include "in_use.hpp"

struct abut_contact {
    std::variant<abut::contact::NodalContact<2>, abut::contact::NodalContact<3>> contact;
    abut_options options;
    std::int32_t index_base;
    bool told_of_compression = false;
    std::int64_t told_of_missed = 0;
    mutable std::atomic_flag in_use{};  // by a call; another one meanwhile is refused

    /// Logs a message. What the host's own log throws is dropped: what is told has happened already.
    void tell(int severity, const std::string& text) const noexcept {
        if (options.log == nullptr) return;
        try {
            options.log(severity, text.c_str(), options.user);
        } catch (...) {
        }
    }
};

namespace abut::c_layer {

template <class Contact>
constexpr int dimension_of = std::is_same_v<std::remove_cvref_t<Contact>, contact::NodalContact<2>> ? 2 : 3;

/// Calls with the contact of the right dimension.
template <class Handle, class Call>
inline void with_contact(Handle* handle, const Call& call) {
    check_pointer(handle, "the handle `contact`");
    const abut::bindings::Use use(
        handle->in_use,
        "this contact is in use: by a callback's own caller, or by another thread. Use one thread at "
        "a time, and call nothing of it from its callbacks.");
    std::visit([&](auto& contact) { call(contact); }, handle->contact);
}

inline int index_base_of(const abut_contact* handle) { return handle == nullptr ? 0 : handle->index_base; }

}  // namespace abut::c_layer
