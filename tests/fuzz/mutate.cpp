#include "fuzz/mutate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace abut::fuzz {
namespace {

constexpr std::array words = {"0",
                              "-1",
                              "1",
                              "3.7",
                              "2147483647",
                              "2147483648",
                              "4294967295",
                              "4294967296",
                              "1000000000",
                              "1000000000000",
                              "9223372036854775807",
                              "99999999999999999999",
                              "1e400",
                              "1e-400",
                              "nan",
                              "-inf",
                              "0x",
                              "x",
                              "\\\n",
                              "-",
                              "",
                              "\n"};
constexpr std::array<std::int64_t, 9> numbers = {0, 1, -1, 255, 65536, 2147483647, 4294967295, 1000000000000, INT64_MIN};

class Mutation {
public:
    Mutation(const std::vector<std::string>& files, std::mt19937_64& random)
        : files_(files), random_(random), text_(files[below(files.size())]) {}

    std::string result() {
        for (std::size_t i = 1 + below(4); i > 0; --i) change();
        return std::move(text_);
    }

private:
    /// Anything where there is nothing to choose from.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

    void change() {
        if (text_.empty()) text_ = "\n";
        const std::size_t at = below(text_.size());
        switch (below(9)) {
            case 0:
                text_[at] = static_cast<char>(text_[at] ^ (1 << below(8)));
                break;
            case 1:
                text_[at] = static_cast<char>(below(256));
                break;
            case 2:
                text_.erase(at, 1 + below(16));
                break;
            case 3:
                text_.insert(at, text_.substr(below(text_.size()), 1 + below(32)));
                break;
            case 4:
                change_line(at);
                break;
            case 5: {
                const std::string& other = files_[below(files_.size())];
                text_.insert(at, other.substr(below(other.size()), below(200)));
                break;
            }
            case 6: {
                const std::int64_t number = numbers[below(numbers.size())];
                const std::size_t size = std::min(text_.size() - at, std::size_t{1} << below(4));
                std::memcpy(text_.data() + at, &number, size);
                break;
            }
            default:
                replace_number(at);
        }
    }
    /// Deletes or doubles the line around `at`.
    void change_line(std::size_t at) {
        const std::size_t before = text_.rfind('\n', at), begin = before == std::string::npos ? 0 : before + 1;
        const std::size_t end = std::min(text_.find('\n', begin), text_.size() - 1) + 1;
        if (begin >= end) return;
        if (below(2) == 0)
            text_.erase(begin, end - begin);
        else
            text_.insert(begin, text_.substr(begin, end - begin));
    }
    /// The first number behind `at`.
    void replace_number(std::size_t at) {
        const std::size_t begin = text_.find_first_of("0123456789", at);
        if (begin == std::string::npos) return;
        const std::size_t end = std::min(text_.find_first_not_of("0123456789", begin), text_.size());
        text_.replace(begin, end - begin, words[below(words.size())]);
    }

    const std::vector<std::string>& files_;
    std::mt19937_64& random_;
    std::string text_;
};

}  // namespace

std::string mutated(const std::vector<std::string>& files, std::mt19937_64& random) {
    return Mutation(files, random).result();
}

}  // namespace abut::fuzz
