#include "abut/contact/shared_work.hpp"

#include <new>
#include <stdexcept>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"

namespace abut::contact {
namespace {

/// Content of an error beside its text.
struct ErrorHead {
    static constexpr std::int64_t unknown = -1, no_memory = -2;

    std::int64_t kind = unknown;  // of ErrorKind, or one of these
    ErrorFacts facts;
};

void put_error(const ErrorHead& head, const std::string& text, ShareWriter& out) {
    out.put(head);
    out.append(std::span<const char>(text));
}

void put_error(const std::exception_ptr& error, ShareWriter& out) {
    try {
        std::rethrow_exception(error);
    } catch (const Error& e) {
        put_error({static_cast<std::int64_t>(e.kind()), e.facts()}, e.what(), out);
    } catch (const std::bad_alloc& e) {
        put_error({ErrorHead::no_memory, {}}, e.what(), out);
    } catch (const std::exception& e) {
        put_error({}, e.what(), out);
    } catch (...) {
        put_error({}, "an error of unknown type", out);
    }
}

[[noreturn]] void throw_error(ShareReader from) {
    const auto head = from.get<ErrorHead>();
    std::string text(from.left(), '\0');
    from.fill(std::span<char>(text));
    if (head.kind == ErrorHead::no_memory) throw std::bad_alloc();
    if (head.kind == ErrorHead::unknown) throw std::runtime_error(text);
    throw_again(Error(static_cast<ErrorKind>(head.kind), text, head.facts), text);
}

}  // namespace

void SharedWork::begin() { mine_.resize(sizeof(Header)); }

std::span<const std::byte> SharedWork::gather(std::size_t n, const std::exception_ptr& error) {
    if (error) {
        begin();
        ShareWriter writer(mine_);
        put_error(error, writer);
    }
    const Header header{n, mine_.size() - sizeof(Header), error ? 1u : 0u};
    std::memcpy(mine_.data(), &header, sizeof(Header));
    const auto all = sharing_->gather(mine_);
    check_all(all, error);
    return all;
}

void SharedWork::check_all(std::span<const std::byte> all, const std::exception_ptr& error) const {
    std::uint64_t n_of_first = 0;
    bool differ = false;
    ShareReader reader(all);
    for (int p = 0; p < n_parts_; ++p) {
        const auto header = reader.get<Header>();
        const auto bytes = reader.bytes(header.n_bytes);
        if (p == 0) n_of_first = header.n;
        differ = differ || header.n != n_of_first;
        if (header.is_error != 0) {
            if (p == part()) std::rethrow_exception(error);
            throw_error(ShareReader(bytes));
        }
    }
    if (differ)
        throw Misuse(
            "contact: the parts that share it have different work. Make them with the same surface and options, and call "
            "the "
            "same functions with the same arguments on each.");
}

}  // namespace abut::contact
