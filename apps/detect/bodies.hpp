#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/health/surface_health.hpp"
#include "apps/detect/options.hpp"

namespace abut::apps {

/// One surface as it came, and what became of it.
struct InputReport {
    std::string name;
    geometry::SurfaceReport health;
    std::vector<std::string> lines;  ///< the health in words
    std::int32_t n_used_faces = 0;
    std::int32_t n_skipped_faces = 0, n_cut_faces = 0, n_flat_pieces = 0;  ///< as in mesh::CleanSurface
    std::int32_t n_ignored_elements = 0;
    std::vector<std::string> warnings;
};

/// All bodies as one surface that moves. Vertices belong to one body each.
struct Bodies {
    std::vector<std::string> names;
    contact::Surface<3> surface;          ///< at present
    std::vector<Vector<3>> start;         ///< (n_vertices) where the run begins [m]
    std::vector<Vector<3>> displacement;  ///< (n_vertices) over the whole run [m], or empty: nothing deforms
    std::vector<std::int32_t> vertex_body;
    std::vector<std::int32_t> face_input;     ///< (n) which input a face is of
    std::vector<std::int32_t> face_of_input;  ///< (n) its index there
    std::vector<std::int64_t> face_label;     ///< (n) what it is called there
    std::vector<InputReport> inputs;

    [[nodiscard]] double mean_face_size() const;  ///< of sqrt(area) at present [m]
    [[nodiscard]] double extent() const;          ///< diagonal of the box around all vertices at present [m]
};

struct ReadingTimes {
    double reading = 0.0, health = 0.0;  ///< [s]
};

/// Reads files and makes shapes, examines them, logs what they are like, and leaves out or refuses what cannot be used.
/// Throws mesh::MeshError or std::runtime_error with file, reason and remedy.
[[nodiscard]] Bodies read_bodies(const DetectOptions& options, ReadingTimes& times);

/// Computes centroids, normals and areas from the vertices. Throws std::runtime_error naming a face that has no area left.
void update_faces(Bodies& bodies, int step);

/// The depth of every face, so that the search reaches pairs with a gap above -depth. Boxes that reach for gaps up to
/// `distance` hold as deep ones too: only what lies beyond is added, the search takes twice the depth of a face on either
/// side.
void set_depth(Bodies& bodies, double depth, double distance);

}  // namespace abut::apps
