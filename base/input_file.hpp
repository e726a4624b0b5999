#pragma once
#include <filesystem>
#include <string>

namespace abut {

/// The bytes of a file that somebody gave: the one place that opens such files. Pipes, devices, sockets and folders are
/// refused, also behind a link, before a byte is read: they may have no end, or none yet.
/// Throws BadInput "<path>: <what is wrong>. <what to do>": not there, no regular file, unreadable.
[[nodiscard]] std::string file_bytes(const std::filesystem::path& path);

}  // namespace abut
