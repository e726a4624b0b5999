#include "abut/base/error.hpp"

namespace abut {

const char* name(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::bad_input:
            return "bad input";
        case ErrorKind::misuse:
            return "misuse";
        case ErrorKind::diverged:
            return "diverged";
        case ErrorKind::too_deep:
            return "too deep";
        case ErrorKind::limit_exceeded:
            return "limit exceeded";
    }
    return "unknown";
}

Error::Error(ErrorKind kind, const std::string& what, const ErrorFacts& facts)
    : std::runtime_error(what), kind_(kind), facts_(facts) {}

}  // namespace abut
