#include "abut/solid/material.hpp"

#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::solid {
namespace {

void require(bool holds, int body, const char* quantity, double value, const char* limit) {
    if (!holds)
        throw BadInput(
            "material of body " + std::to_string(body) + ": " + quantity + " is " + number(value) + "; it must be " + limit,
            {.value = value});
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
}

}  // namespace abut::solid
