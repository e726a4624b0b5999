#include "abut/run/files/checkpoint_file.hpp"

#include <H5Cpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/run/files/files.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view title = "Abut checkpoint, format 2";
constexpr std::size_t head_size = 512;  // HDF5 finds its part behind such a head
constexpr std::size_t memory_block = 1 << 22;

using Bytes = std::vector<std::byte>;

// The file: a head of text, then what HDF5 has made of the content in memory. No failing disc is ever left to HDF5 ----

std::string head(std::span<const std::byte> content) {
    Checksum checksum;
    checksum.add(content);
    std::string text = fmt::format("{}\nAbut {}\nchecksum {:016x} of {} bytes after the first {}\n", title, ABUT_VERSION,
                                   checksum.value(), content.size(), head_size);
    text.resize(head_size, ' ');
    return text;
}

/// To the disc: from here on a loss of power loses nothing.
void synchronise(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool done = file >= 0 && ::fsync(file) == 0;
    const int reason = errno;
    if (file >= 0) ::close(file);
    if (!done) throw BadInput(cannot_be_written(path, std::strerror(reason)));
}

void write_file(const fs::path& path, const std::string& head, std::span<const std::byte> content) {
    std::ofstream file(path, std::ios::binary);
    file.write(head.data(), static_cast<std::streamsize>(head.size()));
    file.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) throw BadInput(cannot_be_written(path, std::strerror(errno)));
    synchronise(path);
}

/// Reads the bytes behind the head.
Bytes read_file(const fs::path& path) {
    const auto refuse = [&](const std::string& why) { throw BadInput(fmt::format("{}: {}", path.string(), why)); };
    const std::string all = file_bytes(path);
    if (!all.starts_with("Abut checkpoint, format ") || all.size() < head_size) refuse("no checkpoint of Abut.");
    if (!all.starts_with(title))
        refuse(fmt::format("not the \"{}\" that is needed. Go on with the Abut that has written it.", title));
    const std::string_view found(all.data(), head_size);
    if (found.find("\nAbut " ABUT_VERSION "\n") == std::string_view::npos)
        refuse("written by another version than " ABUT_VERSION ". Go on with the Abut that has written it.");
    const std::span content = std::as_bytes(std::span(all)).subspan(head_size);
    if (found != head(content)) refuse("damaged: its checksum is wrong.");
    return {content.begin(), content.end()};
}

// The content --------------------------------------------------------------------------------------------------------

template <class T>
const H5::PredType& type_of() {
    if constexpr (std::is_same_v<T, double>)
        return H5::PredType::NATIVE_DOUBLE;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return H5::PredType::NATIVE_INT64;
    else
        return H5::PredType::NATIVE_UINT8;
}

template <class T>
void write(H5::H5File& file, const char* name, const std::vector<T>& values) {
    const hsize_t size = values.size();
    file.createDataSet(name, type_of<T>(), H5::DataSpace(1, &size)).write(values.data(), type_of<T>());
}

/// Memory is taken for what is there, not for what is promised.
template <class T>
std::vector<T> read(const H5::H5File& file, const char* name) {
    const H5::DataSet set = file.openDataSet(name);
    const hssize_t n = set.getSpace().getSimpleExtentNpoints();
    const hsize_t n_bytes = file.getFileSize(), n_stored = set.getStorageSize();
    if (n < 0 || static_cast<hsize_t>(n) > n_bytes / sizeof(T) || static_cast<hsize_t>(n) * sizeof(T) != n_stored)
        throw BadInput(
            fmt::format("its part '{}' promises {} numbers of {} bytes, and {} of its {} bytes are theirs: damaged.", name,
                        n, sizeof(T), n_stored, n_bytes));
    std::vector<T> values(static_cast<std::size_t>(n));
    set.read(values.data(), type_of<T>());
    return values;
}

void write_content(H5::H5File& file, const Checkpoint& checkpoint) {
    const auto& [run, motion, solid, ledger, restarts, inadmissible, looks, observers] = checkpoint;
    write(file, "q", motion.q);
    write(file, "p_before", motion.p_before);
    write(file, "p_after", motion.p_after);
    write(file, "of_scheme", motion.of_scheme);
    write(file, "time", std::vector{motion.time, motion.dt, motion.restart_jumps});
    write(file, "counts", std::vector{motion.steps, inadmissible, restarts.restarts, restarts.shortened, restarts.skipped});
    write(file, "paid", std::vector{restarts.paid});
    write(file, "ledger", ledger);
    write(file, "solid", solid);
    write(file, "looks", looks);
    write(file, "observers", observers);
    write(file, "run", std::vector<char>(run.begin(), run.end()));
}

Checkpoint read_content(const H5::H5File& file) {
    Checkpoint checkpoint;
    dynamics::IntegratorState& motion = checkpoint.motion;
    motion.q = read<double>(file, "q");
    motion.p_before = read<double>(file, "p_before");
    motion.p_after = read<double>(file, "p_after");
    motion.of_scheme = read<double>(file, "of_scheme");
    const auto time = read<double>(file, "time");
    motion.time = time.at(0);
    motion.dt = time.at(1);
    motion.restart_jumps = time.at(2);
    const auto counts = read<std::int64_t>(file, "counts");
    motion.steps = counts.at(0);
    checkpoint.inadmissible_overlaps_max = counts.at(1);
    checkpoint.restarts = {counts.at(2), counts.at(3), counts.at(4), read<double>(file, "paid").at(0)};
    checkpoint.ledger = read<double>(file, "ledger");
    checkpoint.solid = read<std::byte>(file, "solid");
    checkpoint.looks = read<std::byte>(file, "looks");
    checkpoint.observers = read<std::byte>(file, "observers");
    const auto run = read<char>(file, "run");
    checkpoint.run.assign(run.begin(), run.end());
    return checkpoint;
}

/// Access properties of a file that exists in memory alone.
H5::FileAccPropList in_memory() {
    H5::Exception::dontPrint();
    H5::FileAccPropList access;
    access.setCore(memory_block, false);
    return access;
}

Bytes packed(const Checkpoint& checkpoint) {
    H5::H5File file("packed", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, in_memory());
    write_content(file, checkpoint);
    file.flush(H5F_SCOPE_GLOBAL);
    Bytes bytes(static_cast<std::size_t>(H5Fget_file_image(file.getId(), nullptr, 0)));
    if (H5Fget_file_image(file.getId(), bytes.data(), bytes.size()) < 0)
        throw std::runtime_error("checkpoint: HDF5 gives no image of its file");
    return bytes;
}

Checkpoint unpacked(Bytes& bytes) {
    const H5::FileAccPropList access = in_memory();
    H5Pset_file_image(access.getId(), bytes.data(), bytes.size());
    return read_content(H5::H5File("packed", H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access));
}

}  // namespace

namespace {

/// Errors of HDF5 are none of the standard library: nothing of them leaves this file.
Bytes content_of(const Checkpoint& checkpoint, const fs::path& path) {
    try {
        return packed(checkpoint);
    } catch (const H5::Exception& error) {
        throw BadInput(cannot_be_written(path, "HDF5 says " + error.getDetailMsg()));
    }
}

}  // namespace

void write_checkpoint(const Checkpoint& checkpoint, const fs::path& path) {
    const Bytes content = content_of(checkpoint, path);
    fs::path partial = path;
    partial += ".partial";
    try {
        write_file(partial, head(content), content);
        move_file(partial, path);
    } catch (const BadInput&) {
        std::error_code ignored;
        fs::remove(partial, ignored);
        throw;
    }
    synchronise(fs::absolute(path).parent_path());
}

Checkpoint read_checkpoint(const fs::path& path) {
    Bytes content = read_file(path);
    try {
        return unpacked(content);
    } catch (const H5::Exception& error) {
        throw BadInput(fmt::format("{}: cannot be read: {}.", path.string(), error.getDetailMsg()));
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("{}: {}", path.string(), error.what()));
    } catch (const std::out_of_range&) {
        throw BadInput(fmt::format("{}: numbers are missing. Go on with the Abut that has written it.", path.string()));
    }
}

}  // namespace abut::run
