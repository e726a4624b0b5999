#pragma once
#include <array>

#include "abut/base/option.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/ccg/step_device.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/operator/precision.hpp"

namespace abut::solid {

inline constexpr std::array<Word<ContactLaw>, 3> law_words{{{"automatic", ContactLaw::automatic},
                                                            {"reconstruction", ContactLaw::reconstruction},
                                                            {"pair_potential", ContactLaw::pair_potential}}};
inline constexpr std::array<Word<MeanForce>, 4> mean_force_words{{{"automatic", MeanForce::automatic},
                                                                  {"discrete_gradient", MeanForce::discrete_gradient},
                                                                  {"trapezoid", MeanForce::trapezoid},
                                                                  {"closed_trapezoid", MeanForce::closed_trapezoid}}};
inline constexpr std::array<Word<FreeFaceRule>, 3> free_face_words{{{"local_equilibrium", FreeFaceRule::local_equilibrium},
                                                                    {"extrapolate", FreeFaceRule::extrapolate},
                                                                    {"adjacent", FreeFaceRule::adjacent}}};
inline constexpr std::array<Word<CornerRule>, 2> corner_words{
    {{"relaxed", CornerRule::relaxed}, {"fixed", CornerRule::fixed}}};
inline constexpr std::array<Word<Precision>, 2> precision_words{
    {{"double", Precision::double_precision}, {"single", Precision::single_precision}}};
inline constexpr std::array<Word<StepDevice>, 2> device_words{{{"host", StepDevice::host}, {"kokkos", StepDevice::kokkos}}};

}  // namespace abut::solid
