#pragma once
#include <string>
#include <utility>
#include <vector>

#include "apps/detect/bodies.hpp"

namespace abut::apps {

/// Pose of a body: x -> centre + turn (x - centre) + shift. Without a turn just x + shift.
struct Pose {
    Matrix<3> turn = Matrix<3>::Identity();
    Vector<3> centre = Vector<3>::Zero();  ///< [m]
    Vector<3> shift = Vector<3>::Zero();   ///< [m]

    [[nodiscard]] bool turned() const { return turn != Matrix<3>::Identity(); }
    [[nodiscard]] Vector<3> apply(const Vector<3>& x) const {
        return turned() ? Vector<3>(centre + turn * (x - centre) + shift) : Vector<3>(x + shift);
    }
};

/// Motion of all bodies: where they are at each step of a run.
class Motion {
public:
    /// From the options and the script. Throws std::runtime_error naming option, or file, line and column; `bodies` are at
    /// the start.
    Motion(const DetectOptions& options, const Bodies& bodies);

    /// The steps after the start; 0: nothing moves.
    [[nodiscard]] int steps() const { return steps_; }
    /// Whether bodies neither turn nor deform in any step.
    [[nodiscard]] bool only_translates() const;
    [[nodiscard]] Pose pose(std::int32_t body, int step) const;
    /// Puts all vertices and faces where they are at a step. Throws std::runtime_error if one moves farther than
    /// --largest-motion allows, or a face loses its area.
    void move(Bodies& bodies, int step) const;

private:
    /// A motion that goes on evenly from the start to the end.
    struct Even {
        Vector<3> shift = Vector<3>::Zero();
        Vector<3> axis = Vector<3>::UnitZ();
        double angle = 0.0;  ///< [rad]
        Vector<3> centre = Vector<3>::Zero();
    };
    using Script = std::vector<std::pair<int, Pose>>;  // of one body, by step; each pose holds until the next

    void add_translation(const std::string& text, const Bodies& bodies);
    void add_rotation(const std::string& text, const Bodies& bodies);
    void read_script(const std::string& path, const Bodies& bodies);

    std::vector<Even> even_;
    std::vector<Script> scripts_;
    std::vector<Vector<3>> centres_;  // of the boxes at the start
    bool deforms_ = false;
    double largest_motion_ = 1.0;  // in a step, over the extent of all bodies
    int steps_ = 0;
};

}  // namespace abut::apps
