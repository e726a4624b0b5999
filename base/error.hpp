#pragma once
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace abut {

/// Kinds of errors, for a program that has to decide what to do next.
enum class ErrorKind {
    bad_input,       ///< a mesh, a surface, an option or a file that cannot be used: correct it
    misuse,          ///< a call out of order, or a state that no step has reached: correct the program
    diverged,        ///< the run has lost its solution: take a smaller time step
    too_deep,        ///< faces are pressed in deeper than allowed: a smaller step, finer cells or a higher limit
    limit_exceeded,  ///< a search would take more pairs or memory than allowed: raise the limit or ask for less
};

/// "bad input", "misuse", ...
[[nodiscard]] const char* name(ErrorKind kind);

/// Numbers in the text of an error. Members that do not apply keep their defaults.
struct ErrorFacts {
    static constexpr std::int64_t none = -1;

    std::int64_t face_1 = none;                                 ///< index of a face, in the numbering of whoever was asked
    std::int64_t face_2 = none;                                 ///< its partner
    std::int64_t cell = none;                                   ///< index of a cell
    double value = std::numeric_limits<double>::quiet_NaN();    ///< found, in the unit that the text gives
    double allowed = std::numeric_limits<double>::quiet_NaN();  ///< the limit, in the same unit
};

/// Base of all errors that Abut throws. The text says where, how much, how much is allowed, and what to do.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& what, const ErrorFacts& facts = {});

    [[nodiscard]] ErrorKind kind() const { return kind_; }
    [[nodiscard]] const ErrorFacts& facts() const { return facts_; }

private:
    ErrorKind kind_;
    ErrorFacts facts_;
};

/// One type per kind, so that a program catches what it can deal with.
struct BadInput : Error {
    explicit BadInput(const std::string& what, const ErrorFacts& facts = {}) : Error(ErrorKind::bad_input, what, facts) {}
};
struct Misuse : Error {
    explicit Misuse(const std::string& what, const ErrorFacts& facts = {}) : Error(ErrorKind::misuse, what, facts) {}
};
struct Diverged : Error {
    explicit Diverged(const std::string& what, const ErrorFacts& facts = {}) : Error(ErrorKind::diverged, what, facts) {}
};
struct TooDeep : Error {
    explicit TooDeep(const std::string& what, const ErrorFacts& facts = {}) : Error(ErrorKind::too_deep, what, facts) {}
};
struct LimitExceeded : Error {
    explicit LimitExceeded(const std::string& what, const ErrorFacts& facts = {})
        : Error(ErrorKind::limit_exceeded, what, facts) {}
};

}  // namespace abut
