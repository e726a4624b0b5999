#include "abut/solid/material/material.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/material/j2_plasticity.hpp"
#include "abut/solid/material/mooney_rivlin.hpp"

namespace abut::solid {
namespace {

void require(bool holds, int body, const char* quantity, double value, const char* limit) {
    if (!holds)
        throw BadInput(
            "material of body " + std::to_string(body) + ": " + quantity + " is " + number(value) + "; it must be " + limit,
            {.value = value});
}

struct Value {
    const char* name;
    double value;
};

void check_plasticity(const Material& material, int body) {
    const bool yields = material.law == MaterialLaw::j2;
    for (const auto& [name, value] :
         {Value{"yield_stress", material.yield_stress}, Value{"hardening", material.hardening},
          Value{"saturation", material.saturation}, Value{"saturation_rate", material.saturation_rate},
          Value{"kinematic_hardening", material.kinematic_hardening}}) {
        require(yields || value == 0.0, body, name, value, "0, as its law is not j2.");
        require(std::isfinite(value) && value >= 0.0, body, name, value, "finite and >= 0.");
    }
    if (!yields) return;
    require(material.yield_stress > 0.0, body, "yield_stress", material.yield_stress, "> 0 Pa. Mild steel has 2.35e8.");
    require((material.saturation > 0.0) == (material.saturation_rate > 0.0), body, "saturation_rate",
            material.saturation_rate, "> 0 where saturation is, and 0 where it is not.");
}

}  // namespace

void check(const Material& material, int body) {
    require(std::isfinite(material.young) && material.young > 0.0, body, "young (E)", material.young,
            "finite and > 0 Pa. Steel has 2.1e11.");
    require(material.poisson > -1.0 && material.poisson < 0.5, body, "poisson (nu)", material.poisson,
            "above -1 and below 0.5 (an incompressible body has no stable explicit step; take 0.49).");
    require(std::isfinite(material.density) && material.density > 0.0, body, "density (rho)", material.density,
            "finite and > 0 kg/m^3. Steel has 7800.");
    require(std::isfinite(material.eta) && material.eta >= 0.0, body, "eta", material.eta,
            "finite and >= 0 Pa (0: take E).");
    require(material.second_share == 0.0 || material.law == MaterialLaw::mooney_rivlin, body, "second_share",
            material.second_share, "0, as its law is not that of Mooney and Rivlin.");
    for (const auto& [name, value] :
         {Value{"mass_damping", material.mass_damping}, Value{"stiffness_damping", material.stiffness_damping},
          Value{"linear_viscosity", material.linear_viscosity}, Value{"quadratic_viscosity", material.quadratic_viscosity}})
        require(std::isfinite(value) && value >= 0.0, body, name, value, "finite and >= 0 (0: none).");
    check_plasticity(material, body);
    if (material.law != MaterialLaw::neo_hookean && material.law != MaterialLaw::mooney_rivlin) return;
    require(material.poisson >= 0.0, body, "poisson (nu)", material.poisson,
            ">= 0 with a law of rubber, whose energy has no least value below. Take st_venant_kirchhoff.");
    const double most_share = std::min(1.0, 0.5 * material.lambda() / material.mu());
    require(material.second_share >= 0.0 && material.second_share <= most_share, body, "second_share", material.second_share,
            ("between 0 and " + number(most_share) + ", the lesser of 1 and lambda/(2 mu).").c_str());
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
