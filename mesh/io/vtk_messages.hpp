#pragma once
// Private to the layer; not installed.
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>
#include <string>

namespace abut::mesh {

/// Collects, for as long as it lives, the errors and warnings that VTK would print. VTK has one place for them per process:
/// a second object waits for the first to end.
class VtkMessages {
public:
    VtkMessages();
    ~VtkMessages();
    VtkMessages(const VtkMessages&) = delete;
    VtkMessages& operator=(const VtkMessages&) = delete;

    /// On one line; empty when VTK had nothing to say.
    [[nodiscard]] std::string all() const;

private:
    std::unique_lock<std::mutex> lock_;
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkSmartPointer<vtkOutputWindow> collector_;
    bool silenced_ = false;
};

}  // namespace abut::mesh
