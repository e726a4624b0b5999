#pragma once
#include <cstdint>
#include <type_traits>
#include <variant>

#include "abut.h"

/// The fields of abut_options that are options of contact::nodal_options, by the names that they have there. That none is
/// missing, their order and their defaults are tested.
namespace abut::c_layer {

struct OptionField {
    const char* name;
    std::variant<double abut_options::*, std::int64_t abut_options::*, std::int32_t abut_options::*> field;
};

inline constexpr OptionField option_fields[] = {{"skin", &abut_options::skin},
                                                {"largest_motion", &abut_options::largest_motion},
                                                {"max_pairs", &abut_options::max_pairs},
                                                {"compression_warning", &abut_options::compression_warning},
                                                {"compression_limit", &abut_options::compression_limit},
                                                {"facing_full", &abut_options::facing_full},
                                                {"facing_none", &abut_options::facing_none},
                                                {"friction", &abut_options::friction},
                                                {"sliding_friction", &abut_options::sliding_friction},
                                                {"decay_speed", &abut_options::decay_speed},
                                                {"decay_slip", &abut_options::decay_slip},
                                                {"shear_strength", &abut_options::shear_strength},
                                                {"relaxation_time", &abut_options::relaxation_time},
                                                {"events", &abut_options::events},
                                                {"gauss", &abut_options::gauss},
                                                {"self_contact", &abut_options::self_contact}};

}  // namespace abut::c_layer
