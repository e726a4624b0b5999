#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace abut {

/// Mixes bytes into a 64-bit checksum (FNV-1a): finds damage and mix-ups, no attacks.
class Checksum {
public:
    void add(std::span<const std::byte> bytes);
    template <class T>
    void add_values(std::span<const T> values) requires(std::is_arithmetic_v<T>) {
        add(std::as_bytes(values));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

/// A state as bytes: its kind, its version, its content, a checksum. Little-endian machines only.
class StateWriter {
public:
    /// `kind` says what the state is of: "contact 3D".
    StateWriter(const std::string& kind, std::uint32_t version);

    template <class T>
    void put(T value) requires(std::is_arithmetic_v<T>) {
        append(std::as_bytes(std::span<const T, 1>(&value, 1)));
    }
    void put(const std::string& text);
    /// With their number.
    template <class T>
    void put_all(std::span<const T> values) requires(std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>) {
        put(static_cast<std::uint64_t>(values.size()));
        append(std::as_bytes(values));
    }

    /// The bytes, with the checksum at their end.
    [[nodiscard]] std::vector<std::byte> finish() &&;

private:
    void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
    std::vector<std::byte> bytes_;
};

/// Reads in the same order what a StateWriter wrote.
class StateReader {
public:
    /// Throws BadInput if the bytes are not such a state, are damaged, or are of another kind or version. The bytes must
    /// outlive the reader.
    StateReader(std::span<const std::byte> bytes, const std::string& kind, std::uint32_t version);

    template <class T>
    [[nodiscard]] T get() requires(std::is_arithmetic_v<T>) {
        T value;
        take(std::as_writable_bytes(std::span<T, 1>(&value, 1)));
        return value;
    }
    [[nodiscard]] std::string get_text();
    /// As many as were put.
    template <class T>
    [[nodiscard]] std::vector<T> get_all() requires(std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>) {
        std::vector<T> values(take_size(sizeof(T)));
        take(std::as_writable_bytes(std::span(values)));
        return values;
    }
    /// Number of bytes not yet read [bytes].
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    /// Throws BadInput if something is left.
    void finish() const;

private:
    void take(std::span<std::byte> to);
    [[nodiscard]] std::size_t take_size(std::size_t bytes_of_one);

    std::span<const std::byte> bytes_;  // content without the checksum
    std::size_t at_ = 0;
    std::string kind_;
};

}  // namespace abut
