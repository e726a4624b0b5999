#include "abut/contact/surface/blind_corners.hpp"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "abut/contact/surface/ridges.hpp"
#include "abut/geometry/merged_vertices.hpp"

namespace abut::contact {
namespace {

/// A face at a corner, sorted by merged vertex and body.
struct FaceAtCorner {
    std::int32_t merged_vertex;
    std::int32_t body;
    std::int32_t face;
};

template <int Dim>
std::vector<FaceAtCorner> faces_at_corners(const SurfaceView<Dim>& surface) {
    const std::vector<std::int32_t> merged_vertex = geometry::merged_vertices<Dim>(surface.vertices);
    std::vector<FaceAtCorner> all;
    all.reserve(surface.face_vertices.size());
    for (std::int32_t face = 0; face < surface.size(); ++face)
        for (const std::int32_t v : surface.vertices_of(face))
            all.push_back({merged_vertex[static_cast<std::size_t>(v)], surface.body[face], face});
    std::ranges::sort(all, {}, [](const FaceAtCorner& at) { return std::tie(at.merged_vertex, at.body, at.face); });
    return all;
}

/// One corner of one body.
template <int Dim>
class Corner {
public:
    Corner(const SurfaceView<Dim>& surface, std::span<const FaceAtCorner> faces, double seen)
        : surface_(surface), faces_(faces), seen_(seen + cosine_rounding) {}

    [[nodiscard]] bool is_blind() const {
        if (is_blunt()) return false;
        for (std::size_t i = 1; i < faces_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                if (is_unseen(normal(i) + normal(j))) return true;
                for (std::size_t k = 0; Dim == 3 && k < j; ++k)
                    if (is_unseen_at_equal_angles(i, j, k)) return true;
            }
        return false;
    }

private:
    /// Whether the normals are so near each other that every direction between them is near one: a set of points on the
    /// sphere of spherical diameter D lies in a cap of radius R, sin R <= sin(D/2) 2/sqrt(3) (Jung).
    [[nodiscard]] bool is_blunt() const {
        const double enough = 1.0 - 1.5 * (1.0 - seen_ * seen_);
        for (std::size_t i = 1; i < faces_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (normal(i).dot(normal(j)) <= enough) return false;
        return true;
    }

    [[nodiscard]] const Vector<Dim>& normal(std::size_t i) const { return surface_.normal[faces_[i].face]; }

    [[nodiscard]] bool is_unseen_at_equal_angles(std::size_t i, std::size_t j, std::size_t k) const {
        if constexpr (Dim == 3) {
            const Vector<3> d = (normal(j) - normal(i)).cross(normal(k) - normal(i));
            return is_unseen(d) || is_unseen(-d);
        }
        return false;
    }

    /// Whether a face of normal -d can come at the corner without facing a face of it.
    [[nodiscard]] bool is_unseen(const Vector<Dim>& along) const {
        const double length = along.norm();
        if (!(length > cosine_rounding)) return false;
        const Vector<Dim> d = along / length;
        const bool faces_none =
            std::ranges::all_of(faces_, [&](const FaceAtCorner& at) { return surface_.normal[at.face].dot(d) <= seen_; });
        return faces_none && sticks_out(d);
    }

    [[nodiscard]] bool sticks_out(const Vector<Dim>& d) const {
        const Vector<Dim>& tip = surface_.vertices[faces_.front().merged_vertex];
        return std::ranges::all_of(faces_, [&](const FaceAtCorner& at) {
            return std::ranges::all_of(surface_.vertices_of(at.face), [&](std::int32_t v) {
                const Vector<Dim> to_corner = surface_.vertices[v] - tip;
                return to_corner.dot(d) <= cosine_rounding * to_corner.norm();
            });
        });
    }

    const SurfaceView<Dim>& surface_;
    std::span<const FaceAtCorner> faces_;
    double seen_;  // n_i . d above it: the face is seen
};

}  // namespace

template <int Dim>
std::vector<BlindCorner<Dim>> blind_corners(const SurfaceView<Dim>& surface, double facing_cosine) {
    check_sizes(surface);
    const std::vector<FaceAtCorner> all = faces_at_corners(surface);
    std::vector<BlindCorner<Dim>> blind;
    std::int32_t last = -1;  // merged vertex
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].merged_vertex == all[begin].merged_vertex && all[end].body == all[begin].body)
            ++end;
        if (Corner<Dim>(surface, std::span(all).subspan(begin, end - begin), -facing_cosine).is_blind() &&
            std::exchange(last, all[begin].merged_vertex) != all[begin].merged_vertex)
            blind.push_back({all[begin].body, surface.vertices[static_cast<std::size_t>(all[begin].merged_vertex)]});
    }
    return blind;
}

template std::vector<BlindCorner<2>> blind_corners<2>(const SurfaceView<2>&, double);
template std::vector<BlindCorner<3>> blind_corners<3>(const SurfaceView<3>&, double);

}  // namespace abut::contact
