#include "abut/mesh/io/vtk_output.hpp"

#include <vtkErrorCode.h>

#include <exception>

#include "abut/base/error.hpp"
#include "abut/mesh/io/vtk_messages.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {

void name_components(vtkDataArray& array) {
    constexpr std::array<const char*, 6> names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    if (array.GetNumberOfComponents() != 6) return;
    for (int i = 0; i < 6; ++i) array.SetComponentName(i, names[static_cast<std::size_t>(i)]);
}

void add_field(vtkDataSetAttributes& data, vtkDataArray* array, std::size_t wanted, const char* of_what,
               const char* writer) {
    if (static_cast<std::size_t>(array->GetNumberOfTuples()) != wanted)
        throw BadInput(std::string(writer) + ": field '" + array->GetName() + "' has " +
                       std::to_string(array->GetNumberOfTuples()) + " values, one for each of the " +
                       std::to_string(wanted) + " " + of_what + " is needed.");
    data.AddArray(array);
}

PreparedFile prepared_grid(vtkXMLWriter& writer, vtkDataObject& grid, const std::filesystem::path& path) {
    PreparedFile prepared(path);
    const VtkMessages messages;
    writer.SetInputData(&grid);
    writer.SetFileName(prepared.temporary().c_str());
    writer.SetDataModeToAppended();
    writer.EncodeAppendedDataOff();
    writer.SetCompressorTypeToZLib();
    bool is_written = false;
    try {
        is_written = writer.Write() == 1;
    } catch (const std::exception& error) {
        throw MeshError(path.string() + ": cannot be written: VTK ends with " + error.what() +
                        ". Give the run more memory, or write fewer fields.");
    }
    const auto code = static_cast<int>(writer.GetErrorCode());  // the system's below VTK's own
    const std::string said = messages.all();
    if (is_written && code == 0 && said.empty()) return prepared;
    const std::string reason =
        code > 0 && code < vtkErrorCode::FirstVTKErrorCode ? std::generic_category().message(code) : said;
    throw MeshError(path.string() +
                    ": cannot be written: " + (reason.empty() ? "VTK's error " + std::to_string(code) : reason) +
                    ". Check permissions and free space of its folder.");
}

}  // namespace abut::mesh
