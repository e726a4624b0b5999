#pragma once
// Private to the C layer.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <string_view>

#include "abut.h"
#include "abut/base/error.hpp"

namespace abut::c_layer {

/// An exception that came out of a callback of the host.
struct CallbackFailed {};
/// The host has cancelled a step.
struct Cancelled {};

inline int status_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::bad_input:
            return ABUT_BAD_INPUT;
        case ErrorKind::misuse:
            return ABUT_MISUSE;
        case ErrorKind::diverged:
            return ABUT_DIVERGED;
        case ErrorKind::too_deep:
            return ABUT_TOO_DEEP;
        case ErrorKind::limit_exceeded:
            return ABUT_LIMIT_EXCEEDED;
    }
    return ABUT_INTERNAL;
}

/// As much of a text as there is room for; no character of several bytes is cut.
template <std::size_t N>
inline void copy_text(std::string_view text, char (&to)[N]) {
    std::size_t n = std::min(text.size(), N - 1);
    if (n < text.size())
        for (int i = 0; i < 3 && n > 0 && (static_cast<unsigned char>(text[n]) & 0xC0u) == 0x80u; ++i) --n;
    std::memcpy(to, text.data(), n);
    to[n] = '\0';
}

/// A struct of another size is of another version of the header: it is not written to.
inline int report(int status, std::string_view what, const ErrorFacts& facts, int index_base, abut_error* error) noexcept {
    if (error == nullptr || error->struct_size != sizeof(abut_error)) return status;
    const auto in_base = [&](std::int64_t face) { return face == ErrorFacts::none ? face : face + index_base; };
    error->status = status;
    error->face_1 = in_base(facts.face_1);
    error->face_2 = in_base(facts.face_2);
    error->value = facts.value;
    error->allowed = facts.allowed;
    copy_text(what, error->message);
    return status;
}

/// Turns what is thrown into a status.
template <class Call>
inline int guarded(abut_error* error, int index_base, const Call& call) noexcept {
    try {
        if (error != nullptr && error->struct_size != sizeof(abut_error))
            throw Misuse("abut_error: struct_size is not that of this library; begin with ABUT_ERROR_INIT.");
        call();
        return report(ABUT_OK, "", {}, 0, error);
    } catch (const Error& thrown) {
        return report(status_of(thrown.kind()), thrown.what(), thrown.facts(), index_base, error);
    } catch (const Cancelled&) {
        return report(ABUT_CANCELLED, "cancelled by the host; the step did not happen.", {}, 0, error);
    } catch (const CallbackFailed&) {
        return report(ABUT_CALLBACK, "an exception came out of a callback of the host; the call did not happen.", {}, 0,
                      error);
    } catch (const std::bad_alloc&) {
        return report(ABUT_OUT_OF_MEMORY, "out of memory.", {}, 0, error);
    } catch (const std::exception& thrown) {
        return report(ABUT_INTERNAL, thrown.what(), {}, 0, error);
    } catch (...) {
        return report(ABUT_INTERNAL, "an unknown exception.", {}, 0, error);
    }
}

template <class Struct>
inline void check_struct(const Struct* given, const char* name) {
    if (given == nullptr) throw Misuse(std::string(name) + " is NULL; give one.");
    if (given->struct_size != sizeof(Struct))
        throw Misuse(std::string(name) + ": struct_size is " + std::to_string(given->struct_size) +
                     ", that of this library is " + std::to_string(sizeof(Struct)) +
                     ". Begin with its INIT, and compile against the header of this version.");
}

inline void check_pointer(const void* given, const char* name) {
    if (given == nullptr) throw Misuse(std::string(name) + " is NULL; give one.");
}

inline std::int32_t checked_count(std::int64_t n, const char* name) {
    if (n < 0 || n > std::numeric_limits<std::int32_t>::max())
        throw BadInput(std::string(name) + " has " + std::to_string(n) + " entries; 0 to 2147483647 are allowed.",
                       {.value = static_cast<double>(n)});
    return static_cast<std::int32_t>(n);
}

template <class Call>
auto call_host(const Call& call) {
    try {
        return call();
    } catch (...) {
        throw CallbackFailed{};
    }
}

}  // namespace abut::c_layer
