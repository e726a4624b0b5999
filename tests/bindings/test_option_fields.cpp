// The options of contact on nodes as fields of abut_options: none is missing, and none is there that is no option.
#include <catch2/catch.hpp>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "abut.h"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/option_table.hpp"
#include "option_values.hpp"

using namespace abut;
using c_layer::option_fields;

namespace {

abut_options defaults() {
    abut_options options;
    abut_options_init(&options);
    return options;
}

}  // namespace

TEST_CASE("abut_options has a field per option of contact on nodes, in order and of its kind, and no other field",
          "[bindings][options]") {
    const abut_options options = defaults();
    const auto* begin = reinterpret_cast<const char*>(&options);
    std::size_t end = offsetof(abut_options, struct_size) + sizeof(options.struct_size), n = 0;
    REQUIRE(std::size(option_fields) == contact::nodal_options().size());
    for (const auto& option : contact::nodal_options()) {
        const c_layer::OptionField& field = option_fields[n++];
        CAPTURE(option.name, field.name);
        CHECK(option.name == field.name);
        std::visit(
            [&](auto member) {
                const auto& value = options.*member;
                const auto at = static_cast<std::size_t>(reinterpret_cast<const char*>(&value) - begin);
                CHECK(at == end);  // behind the field before, with nothing in between
                end = at + sizeof(value);
            },
            field.field);
        const OptionKind kinds[] = {OptionKind::number, OptionKind::count, OptionKind::truth};
        CHECK(option.kind == kinds[field.field.index()]);
    }
    const std::size_t align = alignof(decltype(options.wanted));
    CHECK(offsetof(abut_options, wanted) == (end + align - 1) / align * align);
}

TEST_CASE("abut_options_init sets the defaults of the table", "[bindings][options]") {
    const abut_options options = defaults();
    const contact::NodalOptions plain;
    for (const c_layer::OptionField& field : option_fields) {
        CAPTURE(field.name);
        CHECK(is_same(c_layer::value_of(options, field), named(contact::nodal_options(), field.name).get(plain)));
    }
    CHECK(options.struct_size == sizeof(options));
    CHECK(options.wanted == nullptr);
    CHECK(options.law_of == nullptr);
    CHECK(options.laws == nullptr);
    CHECK(options.n_laws == 0);
    CHECK(options.own_coefficient == nullptr);
    CHECK(options.interference_time == 0.0);
    CHECK(options.interferes == nullptr);
    CHECK(options.cancel == nullptr);
    CHECK(options.log == nullptr);
    CHECK(options.user == nullptr);
}

TEST_CASE("options of friction make a law of all pairs where one is not the default", "[bindings][options]") {
    contact::NodalOptions options;
    for (const auto& option : contact::friction_options())
        named(contact::nodal_options(), option.name).set(options, option.get(contact::Friction{}));
    CHECK_FALSE(options.friction.any());
    named(contact::nodal_options(), "friction").set(options, 0.3);
    REQUIRE(options.friction.laws.size() == 1);
    CHECK(options.friction.laws.front().coefficient == 0.3);
}
