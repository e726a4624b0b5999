#pragma once
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut {

/// An index of one kind of thing as a type of its own: `enum class Face : std::int32_t {};`. Ids of two numberings
/// cannot be compared, assigned or used in each other's place.
template <class Id>
concept IndexId = std::is_enum_v<Id> && std::same_as<std::underlying_type_t<Id>, std::int32_t>;

/// The plain number of an id.
template <IndexId Id>
[[nodiscard]] constexpr std::int32_t number_of(Id id) {
    return static_cast<std::int32_t>(id);
}

/// The ids from `begin` to before `end`, in order.
template <IndexId Id>
[[nodiscard]] constexpr auto id_range(Id begin, Id end) {
    return std::views::iota(number_of(begin), number_of(end)) | std::views::transform([](std::int32_t i) { return Id{i}; });
}

/// All ids of a numbering: 0, 1, ..., n - 1.
template <IndexId Id>
[[nodiscard]] constexpr auto all_ids(std::int32_t n) {
    return id_range(Id{0}, Id{n});
}

/// One value per thing, owned by somebody else; only ids of its own kind index it.
template <IndexId Id, class T>
class IdSpan {
public:
    constexpr IdSpan() = default;
    constexpr explicit IdSpan(std::span<T> values) : values_(values) {}

    [[nodiscard]] constexpr T& operator[](Id id) const {
        assert(number_of(id) >= 0 && static_cast<std::size_t>(id) < values_.size());
        return values_[static_cast<std::size_t>(id)];
    }
    [[nodiscard]] constexpr std::size_t size() const { return values_.size(); }
    [[nodiscard]] constexpr bool empty() const { return values_.empty(); }
    [[nodiscard]] constexpr auto begin() const { return values_.begin(); }
    [[nodiscard]] constexpr auto end() const { return values_.end(); }
    [[nodiscard]] constexpr std::span<T> values() const { return values_; }  ///< in the order of the ids

private:
    std::span<T> values_;
};

/// One value per thing, owned.
template <IndexId Id, class T>
class IdVector {
public:
    IdVector() = default;
    explicit IdVector(std::size_t n) : values_(n) {}
    IdVector(std::size_t n, const T& value) : values_(n, value) {}
    explicit IdVector(std::vector<T> values) : values_(std::move(values)) {}

    [[nodiscard]] T& operator[](Id id) { return values_[index_of(id)]; }
    [[nodiscard]] const T& operator[](Id id) const { return values_[index_of(id)]; }
    void push_back(const T& value) { values_.push_back(value); }
    void assign(std::size_t n, const T& value) { values_.assign(n, value); }
    void resize(std::size_t n) { values_.resize(n); }
    void clear() { values_.clear(); }
    [[nodiscard]] std::size_t size() const { return values_.size(); }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    [[nodiscard]] auto begin() { return values_.begin(); }
    [[nodiscard]] auto end() { return values_.end(); }
    [[nodiscard]] auto begin() const { return values_.begin(); }
    [[nodiscard]] auto end() const { return values_.end(); }
    [[nodiscard]] std::span<T> values() { return values_; }  ///< in the order of the ids
    [[nodiscard]] std::span<const T> values() const { return values_; }

private:
    [[nodiscard]] std::size_t index_of(Id id) const {
        assert(number_of(id) >= 0 && static_cast<std::size_t>(id) < values_.size());
        return static_cast<std::size_t>(id);
    }

    std::vector<T> values_;
};

}  // namespace abut
