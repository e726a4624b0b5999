#pragma once
#include <array>
#include <vector>

#include "abut/run/steps/simulation.hpp"

/// Round bodies that fall on a plane or run into each other.
namespace abut::studies {

/// A disc that falls on a rigid plane at y = 0 under a body force.
struct DroppedDisc {
    double radius = 20.0;  ///< [m]
    double young = 50.0;   ///< lambda = mu = 20 [Pa]
    double poisson = 0.25;
    double density = 1.0;  ///< [kg/m^3]
    double gravity = 0.1;  ///< [m/s^2]
    double height = 5.0;   ///< of the lowest point [m]
    double size = 2.0;     ///< of cells [m]
};
[[nodiscard]] run::Scene<2> dropped_disc(const DroppedDisc& options);

/// Two equal discs that run into each other along x.
struct TwoDiscs {
    double radius = 1.0, young = 1.0, poisson = 0.3, density = 1.0;  // SI
    double speed = 0.05;                                             ///< of each [m/s]
    double gap = 0.02;                                               ///< between their nearest points [m]
    double offset = 0.0;                                             ///< of their centres along y [m]
    double size = 0.25;                                              ///< of cells [m]
};
[[nodiscard]] run::Scene<2> two_discs(const TwoDiscs& options);

/// Two equal spheres that run into each other along x, with small cells where they meet.
struct TwoSpheres {
    double radius = 0.1, young = 70e9, poisson = 0.3, density = 2700.0;  // SI, aluminium
    double speed = 0.5;                                                  ///< with which they come closer [m/s]
    double faces = 6.0;                                                  ///< in the largest contact radius of Hertz
    double coarse = 0.15;                                                ///< cells far from the contact over the radius [-]
    double gap = 1e-3;                                                   ///< over the largest approach of Hertz [-]
};
[[nodiscard]] run::Scene<3> two_spheres(const TwoSpheres& options);

/// Hertz's quasi-static impact of two equal spheres.
struct HertzImpact {
    double approach;        ///< largest, of their centres [m]
    double force;           ///< largest [N]
    double duration;        ///< [s]
    double contact_radius;  ///< largest [m]
};
[[nodiscard]] HertzImpact hertz_impact(const TwoSpheres& options);

/// Observes the contact of one or two bodies in a run. The force is the mean of a step of the scheme on body 0.
template <int Dim>
class ImpactObserver : public run::Observer<Dim> {
public:
    void begin(const run::Scene<Dim>& scene,
               const run::RunResult<Dim>& result) override;  ///< logs how much there is to do, warns of corners
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override;

    struct Sample {
        double time;                              ///< [s]
        Vector<Dim> force;                        ///< on body 0 [N]
        std::array<Vector<Dim>, 2> displacement;  ///< of the centres of mass [m]
        std::array<Vector<Dim>, 2> velocity;      ///< [m/s]
        double spin;  ///< angular velocity of body 0 about its centre of mass, as of a rigid body; 2D only [rad/s]
        bool in_contact;
    };
    [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
    /// Begin of the first and end of the last step with a pair in contact [s]; NaN without contact.
    [[nodiscard]] double first_contact() const { return first_; }
    [[nodiscard]] double last_contact() const { return last_; }

private:
    std::vector<Sample> samples_;
    double first_ = run::not_given;
    double last_ = run::not_given;
};

/// A scene that was run, with what was seen of its contact.
template <int Dim>
struct ImpactRun {
    run::RunResult<Dim> result;
    ImpactObserver<Dim> observer;
    double seconds = 0.0;  ///< of the run with its set-up, without the mesh
};
/// Shows how far it has come, and warns of what contact did. Throws as `simulate`.
template <int Dim>
[[nodiscard]] ImpactRun<Dim> run_impact(const run::Scene<Dim>& scene, const run::RunOptions& options);

}  // namespace abut::studies
