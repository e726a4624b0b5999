#include "abut/mesh/io/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>

#include <sstream>

namespace abut::mesh {
namespace {

std::mutex output_window_in_use;

class Collector : public vtkOutputWindow {
public:
    static Collector* New();
    vtkTypeMacro(Collector, vtkOutputWindow) void DisplayText(const char* text) override { all += text; }
    void DisplayErrorText(const char* text) override { all += text; }
    void DisplayWarningText(const char* text) override { all += text; }
    void DisplayGenericWarningText(const char* text) override { all += text; }
    void DisplayDebugText(const char*) override {}
    std::string all;
};
vtkStandardNewMacro(Collector);

}  // namespace

VtkMessages::VtkMessages()
    : lock_(output_window_in_use), before_(vtkOutputWindow::GetInstance()), collector_(vtkSmartPointer<Collector>::New()) {
    vtkOutputWindow::SetInstance(collector_);
    // VTK's logger writes to stderr besides; what it writes cannot be asked for, so a host that has changed it is left
    // alone.
    silenced_ = vtkLogger::GetCurrentVerbosityCutoff() == vtkLogger::VERBOSITY_INFO;
    if (silenced_) vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
    if (silenced_) vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);
    vtkOutputWindow::SetInstance(before_);
}

std::string VtkMessages::all() const {
    std::istringstream words(static_cast<Collector*>(collector_.Get())->all);
    std::string line, word;
    while (words >> word) line += std::string(line.empty() ? "" : " ") + word;
    return line;
}

}  // namespace abut::mesh
