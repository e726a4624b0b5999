#include "abut/mesh/io/series_files.hpp"

#include "abut/base/messages.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {

void make_folders(const std::filesystem::path& directory) {
    make_directory(directory);
    make_directory(directory / frames_folder);
}

std::string frame_name(const std::string& basename, std::size_t frame, const char* extension) {
    const std::string number = std::to_string(frame);
    return basename + "_" + std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + extension;
}

std::filesystem::path frame_path(const std::string& basename, std::size_t frame, const char* extension) {
    return std::filesystem::path(frames_folder) / frame_name(basename, frame, extension);
}

PreparedFile prepared_list(const std::filesystem::path& directory, const std::string& basename, const char* extension,
                           const std::vector<double>& times) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (std::size_t i = 0; i < times.size(); ++i)
        text += "<DataSet timestep=\"" + exact_number(times[i]) + "\" part=\"0\" file=\"" +
                frame_path(basename, i, extension).generic_string() + "\"/>\n";
    return prepared_text(directory / (basename + ".pvd"), text + "</Collection>\n</VTKFile>\n");
}

void require_frames(const std::filesystem::path& directory, const std::string& basename, const char* extension,
                    std::size_t n_frames) {
    for (std::size_t i = 0; i < n_frames; ++i)
        if (const auto path = directory / frame_path(basename, i, extension); !std::filesystem::exists(path))
            throw MeshError(path.string() +
                            ": the frame is not there, and the series cannot go on after it. Put it back, or run from the "
                            "start.");
}

}  // namespace abut::mesh
