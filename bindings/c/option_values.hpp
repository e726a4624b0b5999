#pragma once
#include <cstdint>
#include <type_traits>
#include <variant>

#include "abut/base/option.hpp"
#include "option_fields.hpp"

namespace abut::c_layer {

/// Value of a field, as the table of options has it.
inline OptionValue value_of(const abut_options& options, const OptionField& field) {
    return std::visit(
        [&](auto member) {
            if constexpr (std::is_same_v<decltype(member), std::int32_t abut_options::*>)
                return OptionValue(options.*member != 0);
            else
                return OptionValue(options.*member);
        },
        field.field);
}

}  // namespace abut::c_layer
