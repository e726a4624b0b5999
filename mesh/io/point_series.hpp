#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/io/write_vtu.hpp"

namespace abut::mesh {

/// Points of one moment of a run: as many as there are then.
template <int Dim>
struct PointFrame {
    double time = 0.0;                        ///< [s]
    std::span<const Vector<Dim>> position{};  ///< [m]
    std::vector<Field<Dim>> fields{};         ///< each with a value for every point
    Rows faces{};                             ///< segments (2D) or polygons (3D) between points; none: points are shown
    std::vector<NamedNumber> numbers{};
};

/// Points, or faces between them, that come and go, as files for ParaView: frames/BASENAME_000000.vtp, ... BASENAME.pvd
/// lists them with their times.
/// Written as by VtuSeries: 2D vectors get a third component 0, a run that breaks off leaves a readable series.
template <int Dim>
class PointSeries {
public:
    /// Makes the folder if needed. Throws MeshError if that fails.
    PointSeries(std::filesystem::path directory, std::string basename);

    /// Throws BadInput naming the field whose size is wrong, MeshError if a file cannot be written: the list is then as
    /// before the call.
    void write(const PointFrame<Dim>& frame);
    [[nodiscard]] const std::vector<double>& times() const { return times_; }  ///< of the frames [s]
    /// As VtuSeries::go_on_after.
    void go_on_after(std::vector<double> times);

private:
    std::filesystem::path directory_;
    std::string basename_;
    std::vector<double> times_;
};

}  // namespace abut::mesh
