#pragma once
#include <array>
#include <cstddef>
#include <string_view>

#include "abut/solid/kinematics/kinematics.hpp"

namespace abut::solid {

/// Capabilities that a scene may ask of a body and not every kinematics has.
enum class Capability {
    clamp,                   ///< faces whose displacement is prescribed in all directions and constant
    guide,                   ///< faces whose prescribed displacement varies or leaves directions free
    symmetry,                ///< faces that stay on a plane
    following_traction,      ///< one that turns with the body and is no pressure
    following_from_outside,  ///< the same, set by another program between steps
    dead_pressure,           ///< forces of a pressure that stay as they are while faces turn
    bond,                    ///< faces that hold on to those of another body
    large_strains,           ///< a material whose energy is not that of small strains
    flow,                    ///< a material that yields
    temperature,             ///< that is given, and strains
    damping,                 ///< of the material: Rayleigh's and viscosity
    rest,                    ///< a state at rest that is sought (`solve_statics`)
    loaded_rest,             ///< the same under tractions and moments
    local_steps,             ///< steps of its own for each cell
};

/// Which kinematics have one, and why the others have not: the end of a sentence.
struct CapabilityRow {
    Capability capability;
    std::string_view name;
    std::array<bool, 4> of;  ///< by Kinematics
    std::string_view reason;
};

/// All that is refused because of the kinematics of a body. docs/kinematics.md shows it.
inline constexpr std::array<CapabilityRow, 14> capabilities{{
    // clang-format off
    //                                                                              small, floating, finite, rigid
    {Capability::clamp, "clamp",                                                    {true, false, true, false}, "a displacement is given in space, and a frame that turns has no place for it"},
    {Capability::guide, "guide",                                                    {true, false, false, false}, "directions are those of space, and the faces turn"},
    {Capability::symmetry, "symmetry",                                              {true, false, false, false}, "the body may turn off its plane"},
    {Capability::following_traction, "following traction",                          {true, true, false, true}, "the body has no frame, and of what turns with a face the normal alone is known"},
    {Capability::following_from_outside, "following traction from outside",         {true, true, false, true}, "the body has no frame; the program that sets the traction knows its normals"},
    {Capability::dead_pressure, "pressure that does not follow",                    {true, false, false, false}, "forces that stay while faces turn spin up a body that is pressed from all sides"},
    {Capability::bond, "bond",                                                      {true, true, true, false}, "bonds pull at faces through the cells behind them"},
    {Capability::large_strains, "law of large strains",                             {false, false, true, true}, "strains are linear; a rigid body has none, whatever its law"},
    {Capability::flow, "metal that yields",                                         {true, true, true, false}, "nothing deforms"},
    {Capability::temperature, "temperature",                                        {true, true, true, false}, "nothing deforms"},
    {Capability::damping, "damping and viscosity of the material",                  {true, true, true, false}, "nothing deforms"},
    {Capability::rest, "state at rest that is sought",                              {true, false, true, false}, "the search knows no turns of frames and of rigid bodies"},
    {Capability::loaded_rest, "the same under tractions or moments",                {true, false, false, false}, "forces that turn with faces have no potential"},
    {Capability::local_steps, "local time steps",                                   {true, false, false, false}, "a frame couples all cells of its body, and forces of large strains are not linear"},
    // clang-format on
}};

[[nodiscard]] constexpr bool has(Kinematics kinematics, Capability capability) {
    return capabilities[static_cast<std::size_t>(capability)].of[static_cast<std::size_t>(kinematics)];
}

}  // namespace abut::solid
