#pragma once

namespace splotchcl {

constexpr double kpc_in_cm = 3.0856775814913673e21;     // IAU 2015 B2
constexpr double proton_mass_in_g = 1.67262192369e-24;  // CODATA 2018

}  // namespace splotchcl
