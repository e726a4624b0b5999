// The same under libFuzzer, which looks for inputs that reach new lines of code. The format is that of the environment variable
// ABUT_FUZZ_FORMAT (obj, stl, ply, off, vtp, vtu, msh), obj without it:
//
//     ABUT_FUZZ_FORMAT=ply build/fuzz/bin/fuzz_readers_libfuzzer folder_of_inputs
#include <cstdio>
#include <cstdlib>

#include "fuzz/read_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    static const char* const format = std::getenv("ABUT_FUZZ_FORMAT");
    static const abut::fuzz::ScratchFile input(format != nullptr ? format : "obj");
    const auto outcome = abut::fuzz::read_bytes({reinterpret_cast<const char*>(data), size}, input.path());
    if (outcome.is_fault) {
        std::fprintf(stderr, "fault: %s\n", outcome.text.c_str());
        std::abort();
    }
    return 0;
}
