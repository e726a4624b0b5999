#pragma once
#include <cstddef>
#include <span>

namespace abut::contact {

/// The parts of a program, processes as a rule, that have the same contact and work for each other, as one of them sees
/// them. Where contact takes time each part works out its share, and all of them get the results of all: each bit is
/// that of one process. A program with one process has none of this (a null pointer).
///
/// Contact, NodalContact and CandidateSearch take one. All parts make these with the same surface and the same options, and
/// call the same functions in the same order with the same arguments, to the last bit; the other parts would wait for one
/// that does not. Arguments that are refused must be refused on all of them. What goes wrong in the share of one part is
/// thrown on all, as the error of the first part that has one: of the same kind, with the same text and figures (as
/// std::runtime_error where it is neither of Abut nor std::bad_alloc). Calls with different work throw Misuse on all.
class Sharing {
public:
    virtual ~Sharing() = default;

    [[nodiscard]] virtual int part() const = 0;  ///< this one, from 0
    [[nodiscard]] virtual int n_parts() const = 0;
    /// The bytes of all parts, those of part 0 first; they stay until the next call. All parts call together, each with as
    /// many bytes as it has, none included.
    [[nodiscard]] virtual std::span<const std::byte> gather(std::span<const std::byte> mine) = 0;
};

}  // namespace abut::contact
