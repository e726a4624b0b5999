#include "abut/mesh/shapes/gear.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "abut/base/messages.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/estimate.hpp"
#include "abut/mesh/shapes/shapes.hpp"

namespace abut::mesh {
namespace {

/// Vertices of a gear: rows of the ring from the bore to the ground of the gaps, then those of each tooth above it.
class GearGrid {
public:
    explicit GearGrid(const Gear& gear) : gear_(gear) {
        const double module = 2.0 * gear.radius / gear.teeth, pitch = 2.0 * std::numbers::pi / gear.teeth;
        root_ = gear.radius - 1.25 * module;
        tip_ = gear.radius + module;
        const double side = 2.0 * half_tooth(gear, root_) * root_ / gear.cells;  // of a cell
        gap_cells_ = std::max(2, static_cast<int>(std::lround(pitch * root_ / side)) - gear.cells);
        rows_ = std::max(2, static_cast<int>(std::lround((tip_ - root_) / side)));
        layers_ = std::max(2, static_cast<int>(std::lround((root_ - gear.bore) / side)));
    }
    [[nodiscard]] CellSoup<2> soup() const {
        CellSoup<2> soup;
        soup.name = gear_.name;
        soup.body_names = {gear_.name};
        for (int layer = 0; layer <= layers_; ++layer)
            for (int i = 0; i < around(); ++i) soup.vertices.push_back(of_ring(layer, i));
        for (int tooth = 0; tooth < gear_.teeth; ++tooth)
            for (int row = 1; row <= rows_; ++row)
                for (int i = 0; i <= gear_.cells; ++i) soup.vertices.push_back(of_tooth(tooth, row, i));
        const auto append = [&](int a, int b, int c, int d) {
            soup.cell_vertices.append(std::array<std::int32_t, 4>{a, b, c, d});
            soup.cell_shape.push_back(CellShape::quadrangle);
            soup.cell_body.push_back(0);
        };
        for (int layer = 0; layer < layers_; ++layer)
            for (int i = 0; i < around(); ++i)
                append(ring(layer, i), ring(layer + 1, i), ring(layer + 1, i + 1), ring(layer, i + 1));
        for (int tooth = 0; tooth < gear_.teeth; ++tooth)
            for (int row = 0; row < rows_; ++row)
                for (int i = 0; i < gear_.cells; ++i)
                    append(above(tooth, row, i), above(tooth, row + 1, i), above(tooth, row + 1, i + 1),
                           above(tooth, row, i + 1));
        name_faces(soup);
        return soup;
    }

private:
    void name_faces(CellSoup<2>& soup) const {
        soup.group_names = {"teeth", "bore"};
        const auto name = [&](int a, int b, std::int32_t group) { soup.named_faces.push_back({{a, b}, group}); };
        for (int i = 0; i < around(); ++i) {
            name(ring(0, i), ring(0, i + 1), 1);
            if (i % (gear_.cells + gap_cells_) >= gear_.cells) name(ring(layers_, i), ring(layers_, i + 1), 0);
        }
        for (int tooth = 0; tooth < gear_.teeth; ++tooth) {
            for (const int side : {0, gear_.cells})
                for (int row = 0; row < rows_; ++row) name(above(tooth, row, side), above(tooth, row + 1, side), 0);
            for (int i = 0; i < gear_.cells; ++i) name(above(tooth, rows_, i), above(tooth, rows_, i + 1), 0);
        }
    }

    [[nodiscard]] int around() const { return gear_.teeth * (gear_.cells + gap_cells_); }
    [[nodiscard]] int ring(int layer, int i) const { return layer * around() + i % around(); }
    [[nodiscard]] int above(int tooth, int row, int i) const {
        if (row == 0) return ring(layers_, tooth * (gear_.cells + gap_cells_) + i);
        return (layers_ + 1) * around() + (tooth * rows_ + row - 1) * (gear_.cells + 1) + i;
    }
    [[nodiscard]] Vector<2> at(double radius, double angle) const {
        return gear_.centre + radius * Vector<2>(std::cos(angle), std::sin(angle));
    }
    [[nodiscard]] Vector<2> of_tooth(int tooth, int row, int i) const {
        const double radius = root_ + (tip_ - root_) * row / rows_;
        const double middle = gear_.phase + 2.0 * std::numbers::pi * tooth / gear_.teeth;
        return at(radius, middle + half_tooth(gear_, radius) * (2.0 * i / gear_.cells - 1.0));
    }
    [[nodiscard]] Vector<2> of_ring(int layer, int i) const {
        const int tooth = i / (gear_.cells + gap_cells_), k = i % (gear_.cells + gap_cells_);
        const double pitch = 2.0 * std::numbers::pi / gear_.teeth, half = half_tooth(gear_, root_);
        const double from_middle = k <= gear_.cells ? half * (2.0 * k / gear_.cells - 1.0)
                                                    : half + (pitch - 2.0 * half) * (k - gear_.cells) / gap_cells_;
        return at(gear_.bore + (root_ - gear_.bore) * layer / layers_, gear_.phase + pitch * tooth + from_middle);
    }

    const Gear& gear_;
    double root_, tip_;
    int gap_cells_, rows_, layers_;
};

void require(bool good, const Gear& gear, const std::string& what) {
    if (!good) throw MeshError(gear.name + ": " + what);
}

void check(const Gear& gear) {
    const double module = 2.0 * gear.radius / gear.teeth;
    require(gear.teeth >= 4, gear, std::to_string(gear.teeth) + " teeth are given, at least 4 are needed.");
    require(gear.cells >= 2 && gear.cells % 2 == 0, gear,
            std::to_string(gear.cells) + " cells across a tooth are given, an even number above 0 is needed.");
    require(std::isfinite(gear.radius) && gear.radius > 0.0, gear,
            "the radius is " + number(gear.radius) + " m, above 0 m is needed. Change radius.");
    require(gear.bore > 0.0 && gear.bore < gear.radius - 1.25 * module, gear,
            "the bore is " + number(gear.bore) + " m, above 0 m and below " + number(gear.radius - 1.25 * module) +
                " m, the ground of the gaps, is needed. Change bore, or give more teeth.");
    require(gear.pressure_angle >= 0.0 && gear.pressure_angle < 0.25 * std::numbers::pi, gear,
            "the pressure angle is " + number(gear.pressure_angle) +
                ", 0 or above and below pi/4 is needed. Change "
                "pressure_angle.");
    const double tip = half_tooth(gear, gear.radius + module);
    require(tip > 0.0 && std::isfinite(gear.backlash), gear,
            "the tip of a tooth is " + number(2.0 * tip * (gear.radius + module)) +
                " m wide, above 0 m is needed. Give a smaller pressure_angle or backlash, or more teeth.");
}

/// As many as GearGrid makes, up to rounding.
double expected_cells(const Gear& gear) {
    const double module = 2.0 * gear.radius / gear.teeth, pitch = 2.0 * std::numbers::pi / gear.teeth;
    const double root = gear.radius - 1.25 * module, tip = gear.radius + module;
    const double side = 2.0 * half_tooth(gear, root) * root / gear.cells;
    const double of_gap = std::max(2.0, pitch * root / side - gear.cells);
    const double rows = std::max(2.0, (tip - root) / side), layers = std::max(2.0, (root - gear.bore) / side);
    return gear.teeth * (layers * (gear.cells + of_gap) + rows * gear.cells);
}

}  // namespace

double half_tooth(const Gear& gear, double radius) {
    const auto involute = [](double angle) { return std::tan(angle) - angle; };
    const double base = gear.radius * std::cos(gear.pressure_angle);
    const double thickness = 0.5 * std::numbers::pi / gear.teeth - 0.5 * gear.backlash / gear.radius;
    return thickness + involute(gear.pressure_angle) - (radius > base ? involute(std::acos(base / radius)) : 0.0);
}

Mesh<2> gear(const Gear& gear, const MeshOptions& mesh_options) {
    check(gear);
    check_estimate(gear.name, expected_cells(gear), most_structured_cells, mesh_options,
                   "Lower cells_per_tooth or the number of teeth");
    return build_mesh(GearGrid(gear).soup(), mesh_options);
}

}  // namespace abut::mesh
