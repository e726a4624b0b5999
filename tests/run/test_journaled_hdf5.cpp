#include <H5Cpp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "abut/run/files/journaled_hdf5.hpp"
#include "run/folder.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut;

fs::path file_in(const test::Folder& folder, const char* name) {
    fs::create_directories(folder.path());
    return folder.path() / name;
}

H5::H5File open_with(const fs::path& path, unsigned flags) {
    return {path.string(), flags, H5::FileCreatPropList::DEFAULT, run::journaled_access()};
}

std::string group_name(int number) { return "frames/" + std::to_string(number); }

/// A group with three arrays, of which the first one has the number as its values.
void add_group(const H5::H5File& file, int number) {
    file.createGroup(group_name(number));
    const hsize_t n = 500;
    for (const char* name : {"/a", "/b", "/c"}) {
        const std::vector<double> values(n, number);
        file.createDataSet(group_name(number) + name, H5::PredType::NATIVE_DOUBLE, H5::DataSpace(1, &n))
            .write(values.data(), H5::PredType::NATIVE_DOUBLE);
    }
}

/// The first `n` groups are there, whole, and no others.
void check_groups(const H5::H5File& file, int n) {
    CHECK(file.openGroup("frames").getNumObjs() == static_cast<hsize_t>(n));
    for (int i = 0; i < n; ++i)
        for (const char* name : {"/a", "/b", "/c"}) {
            std::vector<double> values(500);
            file.openDataSet(group_name(i) + name).read(values.data(), H5::PredType::NATIVE_DOUBLE);
            CHECK(values == std::vector<double>(500, i));
        }
}

void write_groups(const fs::path& path, int n) {
    H5::H5File file = open_with(path, H5F_ACC_TRUNC);
    file.createGroup("frames");
    for (int i = 0; i < n; ++i) add_group(file, i);
    run::close_journaled(file);
}

/// Runs an action, which ends with `die`, in a process of its own.
void in_own_process(const std::function<void()>& action) {
    const pid_t child = ::fork();
    if (child == 0) action();
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
}

void die() { ::kill(::getpid(), SIGKILL); }

}  // namespace

TEST_CASE("a process that is killed while it changes a file of HDF5 leaves the one that was there", "[run][hdf5]") {
    const test::Folder folder;
    const fs::path path = file_in(folder, "frames.h5");
    const int n = 20;
    write_groups(path, n);
    in_own_process([&] {
        const H5::H5File file = open_with(path, H5F_ACC_RDWR);
        for (int i = n - 1; i >= 15; --i) file.unlink(group_name(i));
        for (int i = 15; i < 40; ++i) add_group(file, i + 100);
        file.flush(H5F_SCOPE_GLOBAL);
        die();
    });
    check_groups(H5::H5File(path.string(), H5F_ACC_RDONLY), n);  // by HDF5's own access
    H5::H5File file = open_with(path, H5F_ACC_RDWR);
    check_groups(file, n);
    for (int i = n; i < n + 5; ++i) add_group(file, i);
    run::close_journaled(file);
    check_groups(H5::H5File(path.string(), H5F_ACC_RDONLY), n + 5);
    CHECK_FALSE(fs::exists(run::journal_of(path)));
}

TEST_CASE("what was written is read before the file is closed, and it ends with its last byte", "[run][hdf5]") {
    const test::Folder folder;
    const fs::path path = file_in(folder, "frames.h5");
    write_groups(path, 3);
    {
        H5::H5File file = open_with(path, H5F_ACC_RDWR);
        file.unlink(group_name(2));
        for (int i = 2; i < 30; ++i) add_group(file, i);
        file.flush(H5F_SCOPE_GLOBAL);
        check_groups(file, 30);
        run::close_journaled(file);
    }
    const H5::H5File file(path.string(), H5F_ACC_RDONLY);
    check_groups(file, 30);
    CHECK(file.getFileSize() == fs::file_size(path));
}

TEST_CASE("a journal that is whole is brought to its places, as often as its process is killed", "[run][hdf5]") {
    const test::Folder folder;
    const fs::path path = file_in(folder, "file.h5");
    std::ofstream(path) << "abcdefgh";
    const auto write_journal = [&] {
        std::ofstream journal(run::journal_of(path), std::ios::binary);
        const auto put = [&](std::uint64_t number) { journal.write(reinterpret_cast<const char*>(&number), sizeof number); };
        put(6), put(2);  // the end, pieces
        put(1), put(2), journal << "XY";
        put(4), put(1), journal << "Z";
    };
    for (int i = 0; i < 2; ++i) {
        write_journal();
        run::finish_journal(path);
        CHECK(test::read_text(path) == "aXYdZf");
        CHECK_FALSE(fs::exists(run::journal_of(path)));
    }
    run::finish_journal(path);  // there is none
    CHECK(test::read_text(path) == "aXYdZf");
}

TEST_CASE("a file of HDF5 whose journal cannot be written stays as it was", "[run][hdf5]") {
    const test::Folder folder;
    const fs::path path = file_in(folder, "frames.h5");
    write_groups(path, 4);
    fs::create_directories(run::journal_of(path) / "in the way");
    H5::H5File file = open_with(path, H5F_ACC_RDWR);
    add_group(file, 4);
    CHECK_THROWS_WITH(run::close_journaled(file),
                      Catch::Contains("frames.h5.journal") && Catch::Contains("cannot be written"));
    check_groups(H5::H5File(path.string(), H5F_ACC_RDONLY), 4);
}
