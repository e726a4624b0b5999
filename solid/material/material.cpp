#include "abut/solid/material/material.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/material/j2_plasticity.hpp"
#include "abut/solid/material/material_numbers.hpp"
#include "abut/solid/material/mooney_rivlin.hpp"

namespace abut::solid {
namespace {

[[noreturn]] void refuse(int body, const std::string& name, double value, const std::string& limit) {
    throw BadInput("material of body " + std::to_string(body) + ": " + name + " is " + number(value) + "; " + limit,
                   {.value = value});
}

void check(const MaterialNumber& of, const Material& material, int body) {
    const double value = material.*of.member;
    if (!of.limits.allow(value)) {
        const std::string remedy = of.limits.remedy;
        refuse(body, of.name, value, "it must be " + text_of(of.limits) + "." + (remedy.empty() ? "" : " " + remedy));
    }
    if (of.law && *of.law != material.law && value != 0.0)
        refuse(body, of.name, value, "it must be 0, as its law is not " + word_of(material_law_words, *of.law) + ".");
}

}  // namespace

void check(const Material& material, int body) {
    for (const MaterialNumber& of : material_numbers) check(of, material, body);
    if (material.law == MaterialLaw::j2 && material.yield_stress == 0.0)
        refuse(body, "yield_stress", 0.0, "j2 needs it to be above 0 Pa. Mild steel has 2.35e8 Pa.");
    if ((material.saturation > 0.0) != (material.saturation_rate > 0.0))
        refuse(body, "saturation_rate", material.saturation_rate,
               "it must be above 0 where saturation is, and 0 elsewhere.");
    if (material.law != MaterialLaw::neo_hookean && material.law != MaterialLaw::mooney_rivlin) return;
    if (material.poisson < 0.0)
        refuse(body, "poisson", material.poisson,
               "a law of rubber takes 0 or above, as its energy has no least value below. Take st_venant_kirchhoff.");
    const double most_share = std::min(1.0, 0.5 * material.lambda() / material.mu());
    if (material.second_share > most_share)
        refuse(body, "second_share", material.second_share,
               "it must be at most " + number(most_share) + ", the lesser of 1 and lambda/(2 mu).");
}

double Material::damping_ratio(double omega, double size) const {
    const double of_viscosity = linear_viscosity * size / std::sqrt(wave_modulus() / density);
    return 0.5 * (mass_damping / omega + (stiffness_damping + of_viscosity) * omega);
}

template <int Dim>
std::shared_ptr<const StoredEnergy<Dim>> stored_energy(const Material& material) {
    if (material.law != MaterialLaw::neo_hookean && material.law != MaterialLaw::mooney_rivlin) return nullptr;
    return std::make_shared<MooneyRivlin<Dim>>(material.lambda(), material.mu(), material.second_share);
}

template <int Dim>
std::shared_ptr<const InelasticLaw<Dim>> inelastic_law(const Material& material) {
    if (material.law != MaterialLaw::j2) return nullptr;
    return std::make_shared<J2Plasticity<Dim>>(material);
}

double Material::flow_stress(double plastic_strain) const {
    return yield_stress + hardening * plastic_strain - saturation * std::expm1(-saturation_rate * plastic_strain);
}

double Material::hardening_modulus(double plastic_strain) const {
    return hardening + saturation * saturation_rate * std::exp(-saturation_rate * plastic_strain);
}

double Material::flow_work(double plastic_strain) const {
    const double linear = (yield_stress + saturation + 0.5 * hardening * plastic_strain) * plastic_strain;
    if (saturation == 0.0) return linear;
    return linear + saturation / saturation_rate * std::expm1(-saturation_rate * plastic_strain);
}

template std::shared_ptr<const StoredEnergy<2>> stored_energy(const Material&);
template std::shared_ptr<const StoredEnergy<3>> stored_energy(const Material&);
template std::shared_ptr<const InelasticLaw<2>> inelastic_law(const Material&);
template std::shared_ptr<const InelasticLaw<3>> inelastic_law(const Material&);

}  // namespace abut::solid
