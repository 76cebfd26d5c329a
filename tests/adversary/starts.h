#pragma once

#include <vector>

#include "adversary/trial.h"
#include "device/scenes.h"

// What classes of trials begin with.
namespace splotchcl::adversary {

inline const std::vector<Light> all_lights = {Light::proportional, Light::ordered,
                                              Light::emission,     Light::factor,
                                              Light::gray,         Light::stars_among_gas};
inline const std::vector<Light> sums = {Light::proportional, Light::emission, Light::factor};
inline const std::vector<double> usual = {1e-3, 1e-2, 1e-4, 1e-5};

double whole(test::Random& random, double low, double high);
Trial with(std::vector<CloudGroup> groups);
CloudGroup group_of(Arrangement arrangement, test::Random& random, double sigma_low,
                    double sigma_high, double peak_low, double peak_high);
CloudGroup even_sheet(test::Random& random, double light_low, double light_high);

Trial few_bright(test::Random& random);
Trial crowd(test::Random& random);
Trial corner(test::Random& random);
Trial ring(test::Random& random);
Trial ring_before_sheet(test::Random& random);
Trial lattice(test::Random& random);
Trial line(test::Random& random);
Trial sheets(test::Random& random);
Trial opaque_before_bright(test::Random& random);
// One of these.
Trial any_base(test::Random& random);

// As scenes of the original program are drawn, too.
Trial cut_kernel(test::Random& random);
// So near that rays find a part of them.
Trial clouds_around(test::Random& random);

}  // namespace splotchcl::adversary
