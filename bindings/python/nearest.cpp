// Distances of surfaces for abut.detection: checked arrays in, faces and points out.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <span>
#include <string>

#include "abut/geometry/nearest/nearest_faces.hpp"
#include "abut/geometry/nearest/penetration.hpp"
#include "abut/geometry/nearest/winding_number.hpp"
#include "arrays.hpp"

namespace {

using namespace abut;
using namespace abut::python;
namespace py = pybind11;

/// Arrays of a surface, and a view of them.
class Surface {
public:
    Surface(const Packed<double>& vertices, const py::object& offsets, const py::object& corners, const char* name)
        : vertices_(vertices), offsets_(integers_of(offsets, "offsets")), corners_(integers_of(corners, "faces")) {
        const std::string of = std::string(name) + ": ";
        if (vertices.ndim() != 2 || vertices.shape(1) != 3)
            throw py::value_error(of + "vertices must have the shape (n, 3)");
        geometry::check_offsets(soup());
        const auto n = vertices.shape(0);
        for (std::int32_t face = 0; face < soup().size(); ++face) {
            const auto of_face = soup().vertices_of(face);
            const auto where = [&] { return of + "face " + std::to_string(face); };
            if (of_face.size() < 3)
                throw py::value_error(where() + " has " + std::to_string(of_face.size()) + " corners, 3 are needed");
            for (const std::int32_t v : of_face) {
                if (v < 0 || v >= n)
                    throw py::value_error(where() + " names vertex " + std::to_string(v) + ", but there are " +
                                          std::to_string(n));
                if (!soup().vertices[static_cast<std::size_t>(v)].allFinite())
                    throw py::value_error(where() + ": its vertex " + std::to_string(v) + " is not finite");
            }
        }
    }
    [[nodiscard]] geometry::FaceSoup soup() const {
        return {as_vectors<3>(std::span(vertices_.data(), static_cast<std::size_t>(vertices_.size()))),
                {offsets_.data(), static_cast<std::size_t>(offsets_.size())},
                {corners_.data(), static_cast<std::size_t>(corners_.size())}};
    }

private:
    Packed<double> vertices_;
    Packed<std::int32_t> offsets_, corners_;
};

py::tuple nearest(const Packed<double>& vertices_1, const py::object& offsets_1, const py::object& corners_1,
                  const Packed<double>& vertices_2, const py::object& offsets_2, const py::object& corners_2) {
    const Surface one(vertices_1, offsets_1, corners_1, "mesh 1"), two(vertices_2, offsets_2, corners_2, "mesh 2");
    geometry::NearestFaces found;
    {
        const py::gil_scoped_release release;
        found = geometry::nearest_faces(one.soup(), two.soup());
    }
    const auto point = [](const Vector<3>& x) { return py::array_t<double>(3, x.data()); };
    const auto& [point_1, point_2, distance] = found.points;
    return py::make_tuple(distance, found.face_1, found.face_2, point(point_1), point(point_2));
}

double penetration(const Packed<double>& vertices_1, const py::object& offsets_1, const py::object& corners_1,
                   const Packed<double>& vertices_2, const py::object& offsets_2, const py::object& corners_2) {
    const Surface one(vertices_1, offsets_1, corners_1, "mesh 1"), two(vertices_2, offsets_2, corners_2, "mesh 2");
    const py::gil_scoped_release release;
    return geometry::penetration_depth(one.soup(), two.soup());
}

bool inside(const Packed<double>& vertices, const py::object& offsets, const py::object& corners,
            const Packed<double>& point) {
    const Surface surface(vertices, offsets, corners, "mesh");
    if (point.size() != 3) throw py::value_error("a point has 3 coordinates");
    const Vector<3> x = as_vectors<3>(std::span(point.data(), 3))[0];
    const py::gil_scoped_release release;
    return geometry::is_inside(surface.soup(), x);
}

}  // namespace

PYBIND11_MODULE(_nearest, module) {
    module.doc() = "Nearest faces of two surfaces, for abut.detection.";
    module.def("is_inside", &inside, "Whether a point is inside of a closed surface whose normals look outwards.");
    module.def("penetration_depth", &penetration, "How deep two closed surfaces lie in each other [m]; 0: they do not.");
    module.def("nearest", &nearest, "(distance, face_1, face_2, point_1, point_2) of two surfaces in space.");
}
