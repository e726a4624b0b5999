#include "abut/run/files/journaled_hdf5.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/run/files/files.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

struct Piece {
    haddr_t begin;
    std::vector<char> bytes;

    [[nodiscard]] haddr_t end() const { return begin + bytes.size(); }
};

bool write_at(int file, const char* from, std::size_t n, haddr_t to) {
    while (n > 0) {
        const ssize_t done = ::pwrite(file, from, n, static_cast<off_t>(to));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        from += done, to += static_cast<haddr_t>(done), n -= static_cast<std::size_t>(done);
    }
    return true;
}

/// Zeros behind the end of the file.
bool read_at(int file, char* to, std::size_t n, haddr_t from) {
    while (n > 0) {
        const ssize_t done = ::pread(file, to, n, static_cast<off_t>(from));
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return false;
        if (done == 0) {
            std::fill_n(to, n, '\0');
            return true;
        }
        to += done, from += static_cast<haddr_t>(done), n -= static_cast<std::size_t>(done);
    }
    return true;
}

// The journal: the end of the file, and for each piece where it begins, its size and its bytes ---------------------------

using Number = std::uint64_t;

struct Journal {
    Number end = 0;
    std::vector<Piece> pieces;
};

void put(std::string& text, Number number) { text.append(reinterpret_cast<const char*>(&number), sizeof number); }

std::string text_of(const Journal& journal) {
    std::string text;
    put(text, journal.end);
    put(text, journal.pieces.size());
    for (const Piece& piece : journal.pieces) {
        put(text, piece.begin);
        put(text, piece.bytes.size());
        text.append(piece.bytes.data(), piece.bytes.size());
    }
    return text;
}

/// Journal of a whole file: it got its name when it was complete.
Journal journal_in(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const auto number = [&] {
        Number read = 0;
        stream.read(reinterpret_cast<char*>(&read), sizeof read);
        return read;
    };
    Journal journal{.end = number()};
    for (Number left = number(); left > 0 && stream; --left) {
        Piece piece{.begin = number()};
        const Number size = number();
        if (!stream || size > fs::file_size(path)) break;
        piece.bytes.resize(size);
        stream.read(piece.bytes.data(), static_cast<std::streamsize>(size));
        journal.pieces.push_back(std::move(piece));
    }
    if (!stream) throw BadInput(path.string() + ": it ends too early. Run from the start.");
    return journal;
}

bool brought_to_its_place(const Journal& journal, int file) {
    for (const Piece& piece : journal.pieces)
        if (!write_at(file, piece.bytes.data(), piece.bytes.size(), piece.begin)) return false;
    return ::ftruncate(file, static_cast<off_t>(journal.end)) == 0;
}

// The driver of HDF5 -----------------------------------------------------------------------------------------------------

struct Journaled : H5FD_t {
    fs::path path;
    int file = -1;
    haddr_t old_end = 0;           // of what must stay as it is until the file is closed
    haddr_t end = 0;               // of what is written
    haddr_t allocated = 0;         // HDF5's end
    std::vector<Piece> pending{};  // within the old bytes, in the order in which they came
};

Journaled& journaled(H5FD_t* file) { return *static_cast<Journaled*>(file); }

const Journaled& journaled(const H5FD_t* file) { return *static_cast<const Journaled*>(file); }

constexpr herr_t done = 0, failed = -1;

herr_t result_of(bool is_done) { return is_done ? done : failed; }

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
    const bool is_new = (flags & H5F_ACC_TRUNC) != 0;
    const int file = ::open(name, O_RDWR | O_CLOEXEC | (is_new ? O_CREAT | O_TRUNC : 0), 0666);
    struct stat status {};
    if (file < 0 || ::fstat(file, &status) != 0) return nullptr;
    auto opened = std::make_unique<Journaled>();
    opened->path = name;
    opened->file = file;
    opened->old_end = opened->end = static_cast<haddr_t>(status.st_size);
    return opened.release();
}

/// Old bytes change here alone, after all that is to be changed stands in the journal.
void end(Journaled& file) {
    const Journal journal{.end = file.allocated, .pieces = std::move(file.pending)};
    const bool is_needed = !journal.pieces.empty();
    if (is_needed) write_whole(journal_of(file.path), text_of(journal));
    if (!brought_to_its_place(journal, file.file) || (is_needed && ::unlink(journal_of(file.path).c_str()) != 0))
        throw BadInput(cannot_be_written(file.path, std::strerror(errno)));
}

/// Failure of the file that was closed last by this thread; empty: none.
thread_local std::string failure;

/// Always done for HDF5, which keeps a file that could not be closed, and fails over it later.
herr_t close_file(H5FD_t* closed) {
    const std::unique_ptr<Journaled> file(&journaled(closed));
    try {
        end(*file);
    } catch (const std::exception& error) {
        failure = error.what();
    }
    ::close(file->file);
    return done;
}

int compare(const H5FD_t* a, const H5FD_t* b) { return journaled(a).path.compare(journaled(b).path); }

herr_t query(const H5FD_t*, unsigned long* flags) {
    if (flags)
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                 H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return done;
}

haddr_t allocated_end(const H5FD_t* file, H5FD_mem_t) { return journaled(file).allocated; }

herr_t set_allocated_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    journaled(file).allocated = end;
    return done;
}

haddr_t end_of(const H5FD_t* file, H5FD_mem_t) { return journaled(file).end; }

herr_t read_bytes(H5FD_t* from, H5FD_mem_t, hid_t, haddr_t begin, std::size_t n, void* to) {
    const Journaled& file = journaled(from);
    if (!read_at(file.file, static_cast<char*>(to), n, begin)) return failed;
    for (const Piece& piece : file.pending) {
        const haddr_t a = std::max(begin, piece.begin), b = std::min<haddr_t>(begin + n, piece.end());
        if (a < b) std::copy_n(piece.bytes.data() + (a - piece.begin), b - a, static_cast<char*>(to) + (a - begin));
    }
    return done;
}

herr_t write_bytes(H5FD_t* to, H5FD_mem_t, hid_t, haddr_t begin, std::size_t n, const void* from) {
    Journaled& file = journaled(to);
    const char* bytes = static_cast<const char*>(from);
    const std::size_t n_old = begin < file.old_end ? std::min<std::size_t>(n, file.old_end - begin) : 0;
    if (n_old > 0) {
        std::erase_if(file.pending,
                      [&](const Piece& piece) { return piece.begin >= begin && piece.end() <= begin + n_old; });
        file.pending.push_back({.begin = begin, .bytes = {bytes, bytes + n_old}});
    }
    file.end = std::max(file.end, begin + n);
    return result_of(write_at(file.file, bytes + n_old, n - n_old, begin + n_old));
}

/// The file itself becomes shorter when it is closed.
herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
    Journaled& truncated = journaled(file);
    if (truncated.end < truncated.allocated) {
        if (::ftruncate(truncated.file, static_cast<off_t>(truncated.allocated)) != 0) return failed;
        truncated.end = truncated.allocated;
    }
    return done;
}

hid_t driver() {
    static const H5FD_class_t facts = [] {
        H5FD_class_t of{};
        of.name = "journaled";
        of.maxaddr = (haddr_t{1} << 63) - 1;
        of.fc_degree = H5F_CLOSE_WEAK;
        of.open = open_file;
        of.close = close_file;
        of.cmp = compare;
        of.query = query;
        of.get_eoa = allocated_end;
        of.set_eoa = set_allocated_end;
        of.get_eof = end_of;
        of.read = read_bytes;
        of.write = write_bytes;
        of.truncate = truncate;
        constexpr std::array<H5FD_mem_t, H5FD_MEM_NTYPES> one_kind = H5FD_FLMAP_SINGLE;
        std::ranges::copy(one_kind, of.fl_map);
        return of;
    }();
    static const hid_t id = H5FDregister(&facts);
    return id;
}

}  // namespace

H5::FileAccPropList journaled_access() {
    H5::FileAccPropList access;
    access.setDriver(driver(), nullptr);
    return access;
}

void close_journaled(H5::H5File& file) {
    failure.clear();
    file.close();
    if (!failure.empty()) throw BadInput(failure);
}

fs::path journal_of(const fs::path& file) {
    fs::path journal = file;
    return journal += ".journal";
}

void finish_journal(const fs::path& file) {
    if (!fs::exists(journal_of(file))) return;
    const Journal journal = journal_in(journal_of(file));
    const int opened = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    const bool is_done = opened >= 0 && brought_to_its_place(journal, opened) && ::unlink(journal_of(file).c_str()) == 0;
    const int reason = errno;
    if (opened >= 0) ::close(opened);
    if (!is_done) throw BadInput(cannot_be_written(file, std::strerror(reason)));
}

}  // namespace abut::run
