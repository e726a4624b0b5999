#include "abut/mesh/io/vtk_input.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/vtk_messages.hpp"
#include "abut/mesh/io/vtk_promises.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

/// `type` as VTK calls it, `what` as people do.
void check_is_whole(const std::string& name, const std::string& contents, const std::string& type, const std::string& what,
                    const std::string& extension) {
    const std::string head = contents.substr(0, 1024);
    if (head.find("<VTKFile") == std::string::npos || head.find(type) == std::string::npos)
        throw MeshError(name + ": is not a VTK " + what + ": '<VTKFile type=\"" + type +
                        "\"' is missing in its first lines. Save it as " + extension + ".");
    if (contents.find("</VTKFile>", contents.size() - std::min<std::size_t>(contents.size(), 64)) == std::string::npos)
        throw MeshError(name + ": the file is truncated: '</VTKFile>' is missing after " + std::to_string(contents.size()) +
                        " bytes. Write the mesh again.");
}

void check_contents(const std::filesystem::path& path, const std::string& type, const std::string& what,
                    const std::string& extension) {
    const std::string contents = file_contents(path);
    check_is_whole(path.string(), contents, type, what, extension);
    check_vtk_promises(path.string(), contents);
}

template <class Reader>
auto read_with(const std::string& name) {
    const VtkMessages messages;
    vtkNew<Reader> reader;
    reader->SetFileName(name.c_str());
    try {
        reader->Update();
    } catch (const std::exception& error) {
        throw MeshError(name + ": cannot be read: VTK ends with " + error.what() +
                        ", as where the file promises more than the memory of this machine holds. Write the mesh again.");
    }
    if (const std::string said = messages.all(); !said.empty())
        throw MeshError(name + ": cannot be read: VTK says: " + said + ". Write the mesh again.");
    return vtkSmartPointer(reader->GetOutput());
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_unstructured_grid(const std::filesystem::path& path) {
    check_contents(path, "UnstructuredGrid", "unstructured grid", ".vtu");
    return read_with<vtkXMLUnstructuredGridReader>(path.string());
}

vtkSmartPointer<vtkPolyData> read_poly_data(const std::filesystem::path& path) {
    check_contents(path, "PolyData", "poly data file", ".vtp");
    return read_with<vtkXMLPolyDataReader>(path.string());
}

std::vector<std::int64_t> body_values(const std::string& name, vtkDataSet& grid) {
    vtkDataArray* array = grid.GetCellData()->GetArray("body");
    std::vector<std::int64_t> values;
    for (vtkIdType cell = 0; array != nullptr && cell < array->GetNumberOfTuples(); ++cell) {
        const double value = array->GetComponent(cell, 0);
        if (value != std::floor(value) || !(std::abs(value) <= 1e9))
            throw MeshError(name + ": cell " + std::to_string(cell) + " has the body " + number(value) +
                            ", a whole number between -1e9 and 1e9 is needed. Correct the cell array 'body'.");
        values.push_back(static_cast<std::int64_t>(value));
    }
    return values;
}

std::vector<std::string> names_of_bodies(std::vector<std::int64_t>& values) {
    std::vector<std::int64_t> distinct = values;
    sort_unique(distinct);
    for (std::int64_t& value : values) value = std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin();
    std::vector<std::string> names;
    for (const std::int64_t value : distinct) names.push_back(std::string("body_") + std::to_string(value));
    return names;
}

}  // namespace abut::mesh
