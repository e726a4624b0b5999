#pragma once
// Private to the layer.
#include <H5Cpp.h>

#include <filesystem>

namespace abut::run {

/// Access to a file of HDF5 that a process killed at any moment leaves as it was when it was opened last, or as it was
/// to be when it was closed. New bytes go behind the old end. Those that would change old ones, most of them lists of
/// names, are kept in memory until the file is closed, written to FILE.journal, and then to their places. A file that
/// is opened with H5F_ACC_TRUNC has no old bytes.
[[nodiscard]] H5::FileAccPropList journaled_access();

/// Closes a file with that access. Throws BadInput where its journal or its bytes cannot be written: without a journal
/// it stays as it was.
void close_journaled(H5::H5File& file);

/// "bodies.h5.journal" of "bodies.h5".
[[nodiscard]] std::filesystem::path journal_of(const std::filesystem::path& file);

/// Brings what a journal holds to its places, if one is there: its process was killed there. Throws BadInput where that
/// cannot be done.
void finish_journal(const std::filesystem::path& file);

}  // namespace abut::run
