#include "abut/base/state_bytes.hpp"

#include <algorithm>
#include <bit>

#include "abut/base/error.hpp"

namespace abut {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint64_t mark = 0x0a1a0a0d54554241;  // "ABUT\r\n\x1a\n": damaged by what takes bytes for text
constexpr std::size_t checksum_size = sizeof(std::uint64_t);

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    Checksum checksum;
    checksum.add(bytes);
    return checksum.value();
}

}  // namespace

void Checksum::add(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) value_ = (value_ ^ std::to_integer<std::uint64_t>(b)) * 1099511628211u;
}

StateWriter::StateWriter(const std::string& kind, std::uint32_t version) {
    put(mark);
    put(kind);
    put(version);
}

void StateWriter::put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    append(std::as_bytes(std::span(text)));
}

std::vector<std::byte> StateWriter::finish() && {
    put(checksum_of(bytes_));
    return std::move(bytes_);
}

StateReader::StateReader(std::span<const std::byte> bytes, const std::string& kind, std::uint32_t version) : kind_(kind) {
    if (bytes.size() < sizeof mark + checksum_size)
        throw BadInput("state of " + kind + ": it has " + std::to_string(bytes.size()) + " bytes; no state is so short.",
                       {.value = static_cast<double>(bytes.size())});
    bytes_ = bytes;
    const std::span<const std::byte> content = bytes.first(bytes.size() - checksum_size);
    if (get<std::uint64_t>() != mark)
        throw BadInput("state of " + kind +
                       ": these bytes are no state that Abut has written. Give what `state()` returned.");
    at_ = content.size();
    const auto expected = get<std::uint64_t>();
    if (checksum_of(content) != expected)
        throw BadInput("state of " + kind + ": the checksum of its " + std::to_string(bytes.size()) +
                       " bytes is wrong: they are damaged. Take an earlier state.");
    bytes_ = content;
    at_ = sizeof mark;
    if (const std::string found = get_text(); found != kind)
        throw BadInput("state of " + kind + ": it is one of " + found + ". Restore it where it belongs.");
    if (const auto found = get<std::uint32_t>(); found != version)
        throw BadInput("state of " + kind + ": it has the version " + std::to_string(found) + ", " +
                           std::to_string(version) + " is needed. Use the Abut that has written it.",
                       {.value = static_cast<double>(found), .allowed = static_cast<double>(version)});
}

std::string StateReader::get_text() {
    std::string text(take_size(1), ' ');
    take(std::as_writable_bytes(std::span(text)));
    return text;
}

/// A number of things that follow: memory is taken for what is there, not for what is promised.
std::size_t StateReader::take_size(std::size_t bytes_of_one) {
    const auto size = get<std::uint64_t>();
    if (size > left() / bytes_of_one) throw BadInput("state of " + kind_ + ": it ends too early.");
    return size;
}

void StateReader::take(std::span<std::byte> to) {
    if (to.size() > left()) throw BadInput("state of " + kind_ + ": it ends too early.");
    std::ranges::copy(bytes_.subspan(at_, to.size()), to.begin());
    at_ += to.size();
}

void StateReader::finish() const {
    if (left() > 0)
        throw BadInput("state of " + kind_ + ": " + std::to_string(left()) + " bytes too many follow it.",
                       {.value = static_cast<double>(left()), .allowed = 0.0});
}

}  // namespace abut
