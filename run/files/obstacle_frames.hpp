#pragma once
// Private to the layer.
#include <filesystem>
#include <string>
#include <vector>

#include "abut/mesh/io/point_series.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

/// The faces of a scene's obstacles where they are at each frame, as a series of points and faces. Faces that are far larger
/// than the bodies, such as those of endless planes, end a few times their extent from them.
template <int Dim>
class ObstacleFrames {
public:
    /// Keeps copies of the obstacles of the scene.
    ObstacleFrames(const std::filesystem::path& directory, const std::string& series, const Scene<Dim>& scene);

    void write(double time);
    /// As mesh::VtuSeries::go_on_after.
    void go_on_after(std::vector<double> times) { series_.go_on_after(std::move(times)); }

private:
    mesh::PointSeries<Dim> series_;
    std::vector<contact::RigidObstacle<Dim>> obstacles_;  // with the faces that are shown
    std::vector<double> number_;                          // of the obstacle, by point
    mesh::Rows faces_;
    std::vector<mesh::NamedNumber> names_;
};

}  // namespace abut::run
