#pragma once
#include <filesystem>
#include <string>

namespace abut::run {

/// A folder of results that this run alone writes to. While it lives, the file .abut.lock in the folder is locked (flock)
/// and says who holds it: program, process and time of the start. The kernel ends the lock with the process, so that a run
/// that was killed leaves the file at most, and never keeps the next one out. Where the file system has no locks, as some
/// of networks have none, runs are not kept apart.
///
/// The file goes with the lock. That is safe: it is removed while it is still locked, and whoever has opened it before then
/// finds another file of that name, or none, once the lock is its own, and begins again.
class FolderLock {
public:
    /// Makes the folder with its parents and takes it. Throws BadInput, with --out as the remedy: naming the owner if
    /// another run has it, in this process or another; naming the reason if the folder cannot be written to, or if a link
    /// or anything but a file is in the place of the lock. What a link leads to is never opened.
    FolderLock(const std::filesystem::path& directory, const std::string& program);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;

private:
    void release() noexcept;

    std::filesystem::path path_;  // of the file, absolute
    int file_ = -1;               // -1: nothing is held
};

}  // namespace abut::run
