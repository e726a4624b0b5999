#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <span>
#include <type_traits>
#include <vector>

#include "abut/contact/sharing.hpp"

namespace abut::contact {

struct IndexRange {
    std::size_t begin;
    std::size_t end;
    [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Range of a part of [0, n): parts are contiguous, in order, and differ by 1 at most.
[[nodiscard]] inline IndexRange part_of(std::size_t n, int part, int n_parts) {
    const auto p = static_cast<std::size_t>(part), of = static_cast<std::size_t>(n_parts);
    return {n * p / of, n * (p + 1) / of};
}

/// Values without pointers, as bytes for the other parts.
class ShareWriter {
public:
    explicit ShareWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

    template <class T>
    void put(const T& value) {
        append(std::span<const T>(&value, 1));
    }
    /// Without their number.
    template <class T>
    void append(std::span<const T> values) {
        static_assert(std::is_standard_layout_v<T>);
        const auto* first = reinterpret_cast<const std::byte*>(values.data());
        bytes_.insert(bytes_.end(), first, first + values.size_bytes());
    }
    /// With their number.
    template <class T>
    void put_all(const std::vector<T>& values) {
        put(values.size());
        append(std::span<const T>(values));
    }

private:
    std::vector<std::byte>& bytes_;
};

/// Reads in the same order what a part wrote.
class ShareReader {
public:
    explicit ShareReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool is_done() const { return bytes_.empty(); }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }
    [[nodiscard]] std::span<const std::byte> bytes(std::size_t n) {
        const auto first = bytes_.first(n);
        bytes_ = bytes_.subspan(n);
        return first;
    }
    template <class T>
    [[nodiscard]] T get() {
        T value;
        fill(std::span<T>(&value, 1));
        return value;
    }
    template <class T>
    void fill(std::span<T> values) {
        static_assert(std::is_standard_layout_v<T>);
        if (values.empty()) return;
        std::memcpy(static_cast<void*>(values.data()), bytes(values.size_bytes()).data(), values.size_bytes());
    }
    /// Reads what `put_all` wrote.
    template <class T>
    void get_all(std::vector<T>& values) {
        values.resize(get<std::size_t>());
        fill(std::span<T>(values));
    }

private:
    std::span<const std::byte> bytes_;
};

/// Shares out work on n things that do not depend on each other. An instance keeps its bytes from call to call.
class SharedWork {
public:
    /// Null: there is one part.
    explicit SharedWork(Sharing* sharing) : sharing_(sharing), n_parts_(sharing ? sharing->n_parts() : 1) {}

    [[nodiscard]] int part() const { return sharing_ ? sharing_->part() : 0; }
    [[nodiscard]] int n_parts() const { return n_parts_; }
    /// Whether to share n things: below that each part does all of them sooner than it hears of the others.
    [[nodiscard]] bool is_worth(std::size_t n) const {
        return n_parts_ > 1 && n >= things_per_part * static_cast<std::size_t>(n_parts_);
    }

    /// Runs work by all parts together, where that is worth it: calls work(range, writer) for the things of this part, then
    /// take(range, reader) for those of each part in order, this one included. Throws what `work` throws on any part.
    template <class Work, class Take>
    void run(std::size_t n, const Work& work, const Take& take) {
        begin();
        std::exception_ptr error;
        try {
            ShareWriter writer(mine_);
            work(part_of(n, part(), n_parts_), writer);
        } catch (...) {
            error = std::current_exception();
        }
        ShareReader all(gather(n, error));
        for (int p = 0; p < n_parts_; ++p) {
            ShareReader of_part(all.bytes(all.get<Header>().n_bytes));
            take(part_of(n, p, n_parts_), of_part);
        }
    }

    static constexpr std::size_t things_per_part = 8;

private:
    struct Header {
        std::uint64_t n;
        std::uint64_t n_bytes;  // that follow
        std::uint64_t is_error;
    };
    void begin();
    /// Bytes of all parts that came to the end of their work; else throws.
    [[nodiscard]] std::span<const std::byte> gather(std::size_t n, const std::exception_ptr& error);
    void check_all(std::span<const std::byte> all, const std::exception_ptr& error) const;

    Sharing* sharing_;
    int n_parts_;
    std::vector<std::byte> mine_;  // a header, then what the work of this part wrote
};

}  // namespace abut::contact
