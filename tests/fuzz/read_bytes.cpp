#include "fuzz/read_bytes.hpp"

#include <sys/resource.h>

#include <exception>
#include <fstream>
#include <random>

#include "abut/base/error.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/read_surface.hpp"

namespace abut::fuzz {
namespace {

/// [MB], the most so far.
long peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

template <class Read>
Outcome outcome_of(const std::filesystem::path& path, Read read) {
    Outcome outcome{false, "read"};
    try {
        (void)read(path);
    } catch (const Error& error) {
        outcome.text = error.what();
        if (outcome.text.find(path.string()) == std::string::npos)
            outcome = {true, "an error that does not name the file: " + outcome.text};
        else if (outcome.text.find("memory of this machine") != std::string::npos ||
                 outcome.text.find("bad_alloc") != std::string::npos)
            outcome = {true, "memory ran out: " + outcome.text};
    } catch (const std::exception& error) {
        outcome = {true, std::string("an exception that is none of ours: ") + error.what()};
    }
    return outcome;
}

}  // namespace

ScratchFile::ScratchFile(const std::string& extension) {
    std::random_device random;
    const auto folder =
        std::filesystem::temp_directory_path() / ("abut_fuzz_" + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directories(folder);
    path_ = folder / ("input." + extension);
}

ScratchFile::~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove_all(path_.parent_path(), ignored);
}

Outcome read_file(const std::filesystem::path& path) {
    const long before = peak_memory();
    Outcome outcome = outcome_of(path, [](const auto& p) { return mesh::read_surface(p); });
    if (path.extension() == ".msh" && !outcome.is_fault) {  // a mesh in the plane goes another way
        const Outcome in_plane = outcome_of(path, [](const auto& p) { return mesh::read_mesh<2>(p); });
        if (in_plane.is_fault) outcome = in_plane;
    }
    if (const long taken = peak_memory() - before; taken > memory_limit)
        outcome = {true, "it took " + std::to_string(taken) + " MB; " + outcome.text};
    return outcome;
}

Outcome read_bytes(std::string_view bytes, const std::filesystem::path& path) {
    std::ofstream(path, std::ios::binary) << bytes;
    return read_file(path);
}

}  // namespace abut::fuzz
