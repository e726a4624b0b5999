#include "support/clippers.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <setjmp.h>
#include <signal.h>

#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <cmath>
#include <limits>
#include <polyclipping/clipper.hpp>

namespace abut::benchmark {
namespace {

using geometry::TrianglePair;
using Corners = std::array<PlaneVector<3>, 3>;

constexpr std::size_t all_pairs = std::numeric_limits<std::size_t>::max();

template <class Number>
struct Point {
    Number x, y;
};

template <class Number>
Number cross(const Point<Number>& start, const Point<Number>& end, const Point<Number>& p) {
    return (end.x - start.x) * (p.y - start.y) - (end.y - start.y) * (p.x - start.x);
}

// Sutherland and Hodgman, as in any textbook.
template <class Number>
Number clipped_area(const std::array<Point<Number>, 3>& a, const std::array<Point<Number>, 3>& b) {
    std::array<Point<Number>, 12> polygon, clipped;
    std::copy(b.begin(), b.end(), polygon.begin());
    int n = 3;
    for (int e = 0; e < 3 && n > 0; ++e) {
        const Point<Number>&start = a[e], &end = a[e == 2 ? 0 : e + 1];
        int m = 0;
        Number height = cross(start, end, polygon[0]);
        for (int k = 0; k < n; ++k) {
            const Point<Number>&p = polygon[k], &q = polygon[k + 1 == n ? 0 : k + 1];
            const Number next = cross(start, end, q);
            if (height >= 0) clipped[m++] = p;
            if ((height >= 0) != (next >= 0)) {
                const Number t = height / (height - next);
                clipped[m++] = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
            }
            height = next;
        }
        n = m;
        std::swap(polygon, clipped);
    }
    Number twice = 0;
    for (int k = 1; k + 1 < n; ++k) twice += cross(polygon[0], polygon[k], polygon[k + 1]);
    return twice / 2;
}

template <class Number>
std::array<Point<Number>, 3> points_of(const Corners& face) {
    std::array<Point<Number>, 3> points;
    for (int i = 0; i < 3; ++i) points[i] = {Number(face[i].x()), Number(face[i].y())};
    return points;
}

// GMP raises SIGFPE, which ends the program, when CGAL asks it for a rational NaN: inexact constructions make some where
// edges almost coincide. The pair is given up, with whatever memory it held, and counts as a failure.
sigjmp_buf next_pair;
void give_up_pair(int) { siglongjmp(next_pair, 1); }

class CatchSigfpe {
public:
    CatchSigfpe() {
        struct sigaction action {};
        action.sa_handler = give_up_pair;
        action.sa_flags = SA_NODEFER;
        sigaction(SIGFPE, &action, &before_);
    }
    ~CatchSigfpe() { sigaction(SIGFPE, &before_, nullptr); }
    CatchSigfpe(const CatchSigfpe&) = delete;
    CatchSigfpe& operator=(const CatchSigfpe&) = delete;

private:
    struct sigaction before_ {};
};

template <double (*area)(const TrianglePair&)>
void each(std::span<const TrianglePair> pairs, std::span<double> areas) {
    const CatchSigfpe guard;
    volatile std::size_t k = 0;  // survives the jump
    if (sigsetjmp(next_pair, 0) != 0) {
        areas[k] = std::numeric_limits<double>::quiet_NaN();
        const std::size_t next = k + 1;
        k = next;
    }
    while (k < pairs.size()) {
        const std::size_t now = k;
        areas[now] = area(pairs[now]);
        k = now + 1;
    }
}

double plain_area(const TrianglePair& pair) {
    return clipped_area(points_of<double>(pair.face_1), points_of<double>(pair.face_2));
}

template <class Kernel>
CGAL::Triangle_2<Kernel> cgal_triangle(const Corners& c) {
    using P = CGAL::Point_2<Kernel>;
    return {P(c[0].x(), c[0].y()), P(c[1].x(), c[1].y()), P(c[2].x(), c[2].y())};
}

// CGAL::intersection is for triangles with an area.
template <class Kernel>
typename Kernel::FT cgal_intersection_area(const TrianglePair& pair) {
    const auto a = cgal_triangle<Kernel>(pair.face_1), b = cgal_triangle<Kernel>(pair.face_2);
    if (a.is_degenerate() || b.is_degenerate()) return 0;
    const auto shared = CGAL::intersection(a, b);
    if (!shared) return 0;
    if (const auto* triangle = boost::get<CGAL::Triangle_2<Kernel>>(&*shared)) return CGAL::abs(triangle->area());
    const auto* polygon = boost::get<std::vector<CGAL::Point_2<Kernel>>>(&*shared);
    typename Kernel::FT area = 0;
    if (polygon != nullptr)
        for (std::size_t k = 1; k + 1 < polygon->size(); ++k)
            area += CGAL::area((*polygon)[0], (*polygon)[k], (*polygon)[k + 1]);
    return CGAL::abs(area);
}

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

template <class Kernel>
double cgal_area(const TrianglePair& pair) {
    return CGAL::to_double(cgal_intersection_area<Kernel>(pair));
}
double cgal_exact_area(const TrianglePair& pair) {
    return CGAL::to_double(CGAL::exact(cgal_intersection_area<Exact>(pair)));
}

double boolean_set_area(const TrianglePair& pair) {
    using Polygon = CGAL::Polygon_2<Exact>;
    Polygon a, b;
    for (int i = 0; i < 3; ++i) {
        a.push_back({pair.face_1[i].x(), pair.face_1[i].y()});
        b.push_back({pair.face_2[i].x(), pair.face_2[i].y()});
    }
    if (a.area() == 0 || b.area() == 0) return 0.0;
    std::vector<CGAL::Polygon_with_holes_2<Exact>> shared;
    CGAL::intersection(a, b, std::back_inserter(shared));
    Exact::FT area = 0;
    for (const auto& part : shared) area += part.outer_boundary().area();
    return CGAL::to_double(area);
}

double boost_area(const TrianglePair& pair) {
    namespace bg = boost::geometry;
    using BoostPoint = bg::model::d2::point_xy<double>;
    using Polygon = bg::model::polygon<BoostPoint, false>;
    Polygon a, b;
    for (int i = 0; i <= 3; ++i) {
        a.outer().emplace_back(pair.face_1[i % 3].x(), pair.face_1[i % 3].y());
        b.outer().emplace_back(pair.face_2[i % 3].x(), pair.face_2[i % 3].y());
    }
    std::vector<Polygon> shared;
    bg::intersection(a, b, shared);
    double area = 0.0;
    for (const Polygon& part : shared) area += bg::area(part);
    return area;
}

// Integer coordinates: the pair fills the grid up to which Clipper multiplies in 64 bits.
double clipper_area(const TrianglePair& pair) {
    double extent = 0.0;
    for (const Corners& face : {pair.face_1, pair.face_2})
        for (const auto& corner : face) extent = std::max(extent, (corner - pair.face_1[0]).cwiseAbs().maxCoeff());
    const double scale = 0x3ffffff0 / extent;
    const auto path = [&](const Corners& face) {
        ClipperLib::Path points;
        for (const auto& corner : face) {
            const PlaneVector<3> p = scale * (corner - pair.face_1[0]);
            points.emplace_back(std::llround(p.x()), std::llround(p.y()));
        }
        return points;
    };
    ClipperLib::Clipper clipper;
    clipper.AddPath(path(pair.face_1), ClipperLib::ptSubject, true);
    clipper.AddPath(path(pair.face_2), ClipperLib::ptClip, true);
    ClipperLib::Paths shared;
    clipper.Execute(ClipperLib::ctIntersection, shared);
    double area = 0.0;
    for (const auto& part : shared) area += ClipperLib::Area(part);
    return area / scale / scale;
}

}  // namespace

std::vector<Clipper> clippers() {
    using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
    return {{"plain clipping in doubles", all_pairs, each<plain_area>},
            {"CGAL Simple_cartesian", all_pairs, each<cgal_area<CGAL::Simple_cartesian<double>>>},
            {"CGAL EPICK", all_pairs, each<cgal_area<Inexact>>},
            {"CGAL EPECK, lazy", 200'000, each<cgal_area<Exact>>},
            {"CGAL EPECK, exact()", 10'000, each<cgal_exact_area>},
            {"CGAL Boolean_set_operations_2", 10'000, each<boolean_set_area>},
            {"Boost.Geometry", 100'000, each<boost_area>},
            {"Clipper", 200'000, each<clipper_area>}};
}

TrueAreas true_areas(const TrianglePair& pair) {
    using Number = CGAL::Exact_rational;
    const auto a = points_of<Number>(pair.face_1), b = points_of<Number>(pair.face_2);
    const Number twice_1 = cross(a[0], a[1], a[2]), twice_2 = cross(b[0], b[1], b[2]);
    Number shared = 0;
    if (twice_1 > 0 && twice_2 > 0) shared = clipped_area(a, b);
    return {CGAL::to_double(shared), 0.5 * CGAL::to_double(twice_1), 0.5 * CGAL::to_double(twice_2), shared > 0};
}

}  // namespace abut::benchmark
