#include "abut/solid/material/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/material/j2_plasticity.hpp"
#include "abut/solid/material/logarithmic_plasticity.hpp"
#include "abut/solid/material/material_numbers.hpp"
#include "abut/solid/material/mooney_rivlin.hpp"
#include "abut/solid/material/orthotropic.hpp"
#include "abut/solid/material/refuse_material.hpp"

namespace abut::solid {
namespace {

void check_number(const MaterialNumber& of, const Material& material, int body) {
    const double value = of.at.of(material);
    if (of.law && *of.law != material.law && value != 0.0)
        refuse_material(body, of.name, value,
                        "it must be 0, as its law is not " + word_of(material_law_words, *of.law) + ".");
    require_allowed("material of body " + std::to_string(body) + ": " + of.name, of.limits, value);
}

struct NamedNumber {
    const char* name;
    MaterialAccess at;
};
/// Pairs of which one means nothing without the other.
constexpr std::array<std::pair<NamedNumber, NamedNumber>, 4> numbers_in_pairs{
    {{{"saturation_rate", number_at<&Material::flow, &MetalFlow::saturation_rate>},
      {"saturation", number_at<&Material::flow, &MetalFlow::saturation>}},
     {{"power_exponent", number_at<&Material::flow, &MetalFlow::power_exponent>},
      {"power_hardening", number_at<&Material::flow, &MetalFlow::power_hardening>}},
     {{"cowper_symonds_exponent", number_at<&Material::flow, &MetalFlow::cowper_symonds_exponent>},
      {"cowper_symonds_rate", number_at<&Material::flow, &MetalFlow::cowper_symonds_rate>}},
     {{"johnson_cook_factor", number_at<&Material::flow, &MetalFlow::johnson_cook_factor>},
      {"johnson_cook_rate", number_at<&Material::flow, &MetalFlow::johnson_cook_rate>}}}};
/// Hardening that a table replaces.
constexpr std::array<NamedNumber, 3> other_hardening{
    {{"hardening", number_at<&Material::flow, &MetalFlow::hardening>},
     {"saturation", number_at<&Material::flow, &MetalFlow::saturation>},
     {"power_hardening", number_at<&Material::flow, &MetalFlow::power_hardening>}}};

void check_table(const Material& material, int body) {
    const auto& table = material.flow.table;
    if (table.empty()) return;
    const auto refuse_row = [&](std::size_t row, const std::string& limit) {
        throw BadInput("material of body " + std::to_string(body) + ": row " + std::to_string(row + 1) +
                           " of hardening_table is [" + number(table[row].plastic_strain) + ", " +
                           number(table[row].stress) + "]; " + limit,
                       {.value = table[row].stress});
    };
    if (material.law != MaterialLaw::j2) refuse_row(0, "there may be none, as its law is not j2.");
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (!std::isfinite(table[i].plastic_strain) || !std::isfinite(table[i].stress))
            refuse_row(i, "it takes a plastic strain and a stress in Pa.");
        if (i == 0 && table[i].plastic_strain != 0.0) refuse_row(i, "it must begin at the plastic strain 0.");
        if (i == 0 && table[i].stress != material.flow.yield_stress)
            refuse_row(i, "its stress is where flow begins, but yield_stress is " + number(material.flow.yield_stress) +
                              " Pa. Give one of them, or both alike.");
        if (i > 0 && !(table[i].plastic_strain > table[i - 1].plastic_strain))
            refuse_row(i, "plastic strains must grow from row to row.");
        if (i > 0 && !(table[i].stress >= table[i - 1].stress))
            refuse_row(i, "stresses must not fall from row to row: metal that softens is not made.");
    }
    for (const NamedNumber& other : other_hardening)
        if (other.at.of(material) > 0.0)
            refuse_material(body, other.name, other.at.of(material),
                            "it must be 0 beside hardening_table, which says all of it.");
}

/// Of materials that have none.
void check_axes(const Material& material, int body) {
    const Orthotropy plain, &given = material.orthotropic;
    for (const auto& [name, axis, other] :
         {std::tuple{"axis_1", given.axis_1, plain.axis_1}, std::tuple{"axis_2", given.axis_2, plain.axis_2}})
        if (axis != other)
            throw BadInput("material of body " + std::to_string(body) + ": it has " + name + ", but its law " +
                           word_of(material_law_words, material.law) +
                           " is the same in all directions. Take law = \"orthotropic\", or leave the axis out.");
}

}  // namespace

void check(const Material& material, int body) {
    for (const MaterialNumber& of : material_numbers) check_number(of, material, body);
    check_table(material, body);
    if (material.law == MaterialLaw::j2 && material.flow.yield_stress == 0.0)
        refuse_material(body, "yield_stress", 0.0, "j2 needs it to be above 0 Pa. Mild steel has 2.35e8 Pa.");
    for (const auto& [value, with] : numbers_in_pairs)
        if ((value.at.of(material) > 0.0) != (with.at.of(material) > 0.0))
            refuse_material(body, value.name, value.at.of(material),
                            std::string("it must be above 0 where ") + with.name + " is, and 0 elsewhere.");
    if (material.flow.cowper_symonds_rate > 0.0 && material.flow.johnson_cook_rate > 0.0)
        refuse_material(body, "johnson_cook_rate", material.flow.johnson_cook_rate,
                        "it must be 0, as the rate counts by cowper_symonds_rate already. Take one law of rates.");
    if (material.law == MaterialLaw::orthotropic) return check_orthotropic(material, body);
    check_axes(material, body);
    if (material.law != MaterialLaw::neo_hookean && material.law != MaterialLaw::mooney_rivlin) return;
    if (material.poisson < 0.0)
        refuse_material(
            body, "poisson", material.poisson,
            "a law of rubber takes 0 or above, as its energy has no least value below. Take st_venant_kirchhoff.");
    const double most_share = std::min(1.0, 0.5 * material.lambda() / material.mu());
    if (material.second_share > most_share)
        refuse_material(body, "second_share", material.second_share,
                        "it must be at most " + number(most_share) + ", the lesser of 1 and lambda/(2 mu).");
}

void refuse_material(int body, const std::string& name, double value, const std::string& limit) {
    throw BadInput("material of body " + std::to_string(body) + ": " + name + " is " + number(value) + "; " + limit,
                   {.value = value});
}

double Material::damping_ratio(double omega, double size) const {
    const double of_viscosity = damping.linear_viscosity * size / std::sqrt(wave_modulus() / density);
    return 0.5 * (damping.mass / omega + (damping.stiffness + of_viscosity) * omega);
}

double Material::mean_lambda() const { return mean_moduli(*this).lambda; }

double Material::mean_mu() const { return mean_moduli(*this).mu; }

double Material::largest_of_axes() const { return largest_wave_modulus(*this); }

template <int Dim>
std::shared_ptr<const StoredEnergy<Dim>> stored_energy(const Material& material) {
    if (material.law == MaterialLaw::orthotropic) return std::make_shared<OrthotropicEnergy<Dim>>(material);
    if (material.law != MaterialLaw::neo_hookean && material.law != MaterialLaw::mooney_rivlin) return nullptr;
    return std::make_shared<MooneyRivlin<Dim>>(material.lambda(), material.mu(), material.second_share);
}

template <int Dim>
std::shared_ptr<const InelasticLaw<Dim>> inelastic_law(const Material& material) {
    if (material.law != MaterialLaw::j2) return nullptr;
    if (material.flow.kinematic_hardening > 0.0) return std::make_shared<LogarithmicPlasticity<Dim>>(material);
    return std::make_shared<J2Plasticity<Dim>>(material);
}

template std::shared_ptr<const StoredEnergy<2>> stored_energy(const Material&);
template std::shared_ptr<const StoredEnergy<3>> stored_energy(const Material&);
template std::shared_ptr<const InelasticLaw<2>> inelastic_law(const Material&);
template std::shared_ptr<const InelasticLaw<3>> inelastic_law(const Material&);

}  // namespace abut::solid
