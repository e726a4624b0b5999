#include "abut/mesh/io/vtk_data.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <vector>

#include "abut/base/parallel.hpp"

namespace abut::mesh {
namespace {

constexpr std::size_t block_size = 32768;
constexpr int compression_level = 5;  // these two are VTK's

/// One stream for many blocks: what it takes to set one up is a tenth of the time of a block.
class Deflater {
public:
    Deflater() {
        if (deflateInit(&stream_, compression_level) != Z_OK) throw std::bad_alloc();
    }
    ~Deflater() { deflateEnd(&stream_); }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;

    std::string block(std::string_view bytes) {
        std::string result(compressBound(bytes.size()), '\0');
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not write there
        stream_.avail_in = static_cast<uInt>(bytes.size());
        stream_.next_out = reinterpret_cast<Bytef*>(result.data());
        stream_.avail_out = static_cast<uInt>(result.size());
        deflate(&stream_, Z_FINISH);  // ends, since the room is large enough
        result.resize(stream_.total_out);
        deflateReset(&stream_);
        return result;
    }

private:
    z_stream stream_{};
};

void append_number(std::string& bytes, std::size_t number) {
    const auto value = static_cast<std::uint32_t>(number);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

constexpr std::array<std::int8_t, 256> digits_of_base64() {
    std::array<std::int8_t, 256> digits{};
    digits.fill(-1);
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < letters.size(); ++i)
        digits[static_cast<unsigned char>(letters[i])] = static_cast<std::int8_t>(i);
    return digits;
}

}  // namespace

std::string zlib_blocks(std::string_view bytes) {
    std::vector<std::string> blocks((bytes.size() + block_size - 1) / block_size);
    parallel_ranges(
        std::ssize(blocks),
        [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            Deflater deflater;
            for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
                blocks[i] = deflater.block(bytes.substr(i * block_size, block_size));
        },
        8);
    std::string result;
    append_number(result, blocks.size());
    append_number(result, block_size);
    append_number(result, bytes.size() % block_size);
    for (const std::string& block : blocks) append_number(result, block.size());
    for (const std::string& block : blocks) result += block;
    return result;
}

bool append_inflated(std::string& bytes, std::string_view block, std::size_t n) {
    if (n > largest_zlib_ratio * block.size()) return false;
    const std::size_t before = bytes.size();
    bytes.resize(before + n);
    uLongf n_out = n;
    return uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &n_out, reinterpret_cast<const Bytef*>(block.data()),
                      block.size()) == Z_OK &&
           n_out == n;
}

std::string from_base64(std::string_view text, std::size_t n) {
    static constexpr std::array<std::int8_t, 256> digits = digits_of_base64();
    std::string bytes;
    bytes.reserve(std::min(n, text.size()));
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char letter : text) {
        const std::int8_t digit = digits[static_cast<unsigned char>(letter)];
        if (digit < 0 || bytes.size() == n) break;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        n_bits += 6;
        if (n_bits < 8) continue;
        n_bits -= 8;
        bytes.push_back(static_cast<char>(bits >> n_bits & 0xFF));
    }
    return bytes;
}

}  // namespace abut::mesh
