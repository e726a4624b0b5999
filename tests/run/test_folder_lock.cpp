#include "abut/run/files/folder_lock.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "run/folder.hpp"

namespace {

using namespace abut;
using Catch::Contains;
using run::FolderLock;
using test::Folder;
namespace fs = std::filesystem;

/// While it lives, no file of this process grows.
class FullDisc {
public:
    FullDisc() : before_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &limit_);
        const rlimit nothing{.rlim_cur = 0, .rlim_max = limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &nothing);
    }
    ~FullDisc() {
        setrlimit(RLIMIT_FSIZE, &limit_);
        std::signal(SIGXFSZ, before_);
    }
    FullDisc(const FullDisc&) = delete;
    FullDisc& operator=(const FullDisc&) = delete;

private:
    void (*before_)(int);
    rlimit limit_{};
};

/// What the refusal of the folder says; empty: it is not refused.
std::string refusal(const fs::path& directory) {
    try {
        const FolderLock lock(directory, "second");
        return "";
    } catch (const BadInput& error) {
        return error.what();
    }
}

}  // namespace

TEST_CASE("a folder that a run has is refused to others, with the owner and the remedy, until that run ends",
          "[run][lock]") {
    const Folder folder;
    const fs::path out = folder.path() / "a" / "b";  // made
    {
        const FolderLock lock(out, "first");
        CHECK_THAT(refusal(out), Contains("--out " + out.string()) &&
                                     Contains("first, process " + std::to_string(getpid()) + ", since 20") &&
                                     Contains("another folder with --out"));
        CHECK(refusal(folder.path() / "a").empty());  // one folder, not those above it
    }
    CHECK(refusal(out).empty());
    CHECK(fs::is_empty(out));
}

TEST_CASE("a lock that is handed on is held as long as its last owner lives", "[run][lock]") {
    const Folder folder;
    std::optional<FolderLock> kept;
    {
        FolderLock lock(folder.path(), "first");
        kept = std::move(lock);
    }
    CHECK_FALSE(refusal(folder.path()).empty());
    kept = FolderLock(folder.path() / "other", "first");
    CHECK(refusal(folder.path()).empty());
    kept.reset();
    CHECK(refusal(folder.path() / "other").empty());
}

TEST_CASE("a lock file that a killed run has left keeps nobody out", "[run][lock]") {
    const Folder folder;
    fs::create_directories(folder.path());
    test::write_text(folder.path() / ".abut.lock",
                     "killed, process 1, since 2026-01-01 00:00:00 UTC, and more than a line\n\n");
    const FolderLock lock(folder.path(), "first");
    CHECK(test::read_text(folder.path() / ".abut.lock").starts_with("first, process "));
    CHECK_THAT(refusal(folder.path()), Contains("first, process") && !Contains("killed"));
}

TEST_CASE("a link in the folder leads no run to a foreign file", "[run][lock]") {
    const Folder folder;
    const fs::path out = folder.path() / "out", foreign = folder.path() / "foreign.txt";
    fs::create_directories(out);
    test::write_text(foreign, "not mine\n");
    SECTION("a symbolic link in the place of the lock is refused") {
        fs::create_symlink(foreign, out / ".abut.lock");
        CHECK_THAT(refusal(out), Contains("--out") && Contains("a link is in the place of .abut.lock"));
    }
    SECTION("a symbolic link to nothing makes no file") {
        fs::create_symlink(folder.path() / "new.txt", out / ".abut.lock");
        CHECK_FALSE(refusal(out).empty());
        CHECK_FALSE(fs::exists(folder.path() / "new.txt"));
    }
    SECTION("a second name of the file is refused") {
        fs::create_hard_link(foreign, out / ".abut.lock");
        CHECK_THAT(refusal(out), Contains(".abut.lock is no file of its own"));
    }
    SECTION("no other file proves that the folder can be written to") {
        fs::create_symlink(foreign, out / ".writable");
        CHECK(refusal(out).empty());
        CHECK(fs::is_symlink(out / ".writable"));
    }
    CHECK(test::read_text(foreign) == "not mine\n");
}

TEST_CASE("a folder on a full disc is refused, and no lock is left", "[run][lock]") {
    const Folder folder;
    fs::create_directories(folder.path());
    std::string text;
    {
        const FullDisc full;
        text = refusal(folder.path());
    }
    CHECK_THAT(text, Contains("--out") && Contains("cannot be written to") && Contains("Choose another folder"));
    CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("however often a folder is taken and given back, no two have it at once", "[run][lock]") {
    const Folder folder;
    std::atomic<int> holders{0}, most{0}, taken{0};
    const auto take_often = [&] {
        for (int i = 0; i < 300; ++i) try {
                const FolderLock lock(folder.path(), "one of many");
                most = std::max(most.load(), ++holders);
                ++taken;
                --holders;
            } catch (const BadInput&) {
                std::this_thread::yield();
            }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(take_often);
    for (std::thread& thread : threads) thread.join();
    CHECK(most == 1);
    CHECK(taken > 0);
    CHECK(refusal(folder.path()).empty());
}
