#include "abut/base/throw_again.hpp"

namespace abut {

void throw_again(const Error& error, const std::string& what) {
    switch (error.kind()) {
        case ErrorKind::bad_input:
            throw BadInput(what, error.facts());
        case ErrorKind::misuse:
            throw Misuse(what, error.facts());
        case ErrorKind::diverged:
            throw Diverged(what, error.facts());
        case ErrorKind::too_deep:
            throw TooDeep(what, error.facts());
        case ErrorKind::limit_exceeded:
            throw LimitExceeded(what, error.facts());
    }
    throw Error(error.kind(), what, error.facts());
}

}  // namespace abut
