#include "adversary/classes.h"
#include "adversary/starts.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

Trial vector_colors(Random& random) {
  Trial trial = random.uniform() < 0.5 ? crowd(random) : few_bright(random);
  trial.own_colors = 1;
  for (CloudGroup& group : trial.groups)
    group.color = random.logarithmic(1, 1e4);
  return trial;
}

Trial with_background(Random& random) {
  Trial trial = any_base(random);
  trial.background = random.logarithmic(0.1, 1e4);
  trial.source = random.logarithmic(0.01, 100);
  return trial;
}

// As scenes of the original program are drawn.
void use_kernel_of_original(Trial& trial, Random& random) {
  trial.sampling = Sampling::center;
  trial.cut = random.uniform(1.2, 3);
}

// Thin matter of a bright source beside, before or behind thick matter of a faint one.
Trial two_sources(Random& random) {
  CloudGroup gas = group_of(Arrangement::point, random, 1, 20, 0.05, 5);
  gas.star = 0;
  gas.copies = whole(random, 1, 20);
  CloudGroup stars = group_of(Arrangement::point, random, 1, 30, 1e-3, 1);
  stars.star = 1;
  stars.copies = whole(random, 1, 40);
  Trial trial = with({gas, stars});
  trial.source = random.logarithmic(1e-3, 1);
  trial.star_source = random.logarithmic(1, 1e3);
  if (random.uniform() < 0.5) use_kernel_of_original(trial, random);
  return trial;
}

// One channel is deep where the mean of all is not.
Trial tinted_matter(Random& random) {
  Trial trial = any_base(random);
  trial.tint = random.uniform(0.8, 1);
  trial.source = random.logarithmic(1e-3, 10);
  trial.background = random.logarithmic(1, 1e3);
  if (random.uniform() < 0.5) use_kernel_of_original(trial, random);
  return trial;
}

Trial many_colors(Random& random) {
  Trial trial = any_base(random);
  trial.knots = whole(random, 3, 300);
  if (random.uniform() < 0.7) trial.decades = random.logarithmic(0.3, 20);
  for (CloudGroup& group : trial.groups)
    group.peak = random.logarithmic(1, 1e5);
  return trial;
}

Trial equal_layers_behind_opaque(Random& random) {
  CloudGroup opaque = group_of(Arrangement::point, random, 3, 30, 3, 100);
  CloudGroup layers = group_of(Arrangement::point, random, 2, 20, 1e-3, 3);
  layers.x = opaque.x + random.uniform(-5, 5);
  layers.y = opaque.y + random.uniform(-5, 5);
  layers.copies = whole(random, 100, 2000);
  layers.depth = 2 * opaque.depth;
  Trial trial = with({opaque, layers});
  trial.background = random.logarithmic(3, 300);
  return trial;
}

Trial certified(Random& random) {
  const auto choice = static_cast<int>(random.uniform(0, 7));
  Trial trial = choice == 0   ? two_sources(random)
                : choice == 1 ? tinted_matter(random)
                : choice == 2 ? many_colors(random)
                : choice == 3 ? cut_kernel(random)
                : choice == 4 ? clouds_around(random)
                              : any_base(random);
  trial.certify = 1;
  return trial;
}

std::vector<Light> with_two_sources() {
  std::vector<Light> lights = all_lights;
  lights.push_back(Light::two_sources);
  return lights;
}

}  // namespace

std::vector<TrialClass> light_classes() {
  return {
      {"vector_colors", "a search that looks at palettes sees nothing of own colors", all_lights,
       usual, vector_colors},
      {"opaque_before_bright",
       "what shines through has the digits of the transmittance",
       {Light::stars_among_gas, Light::ordered, Light::gray, Light::factor},
       usual,
       opaque_before_bright},
      {"background", "light behind clouds is dimmed by what they lose", all_lights, usual,
       with_background},
      {"two_sources",
       "thin matter may shine brighter than anything that is seen",
       {Light::two_sources},
       usual,
       two_sources},
      {"tinted_matter",
       "one channel hides what the others show",
       {Light::ordered},
       usual,
       tinted_matter},
      {"equal_layers_behind_opaque", "they err by equal roundings of an opacity close to 1",
       all_lights, usual, equal_layers_behind_opaque},
      {"many_colors", "places in a palette are rounded", all_lights, usual, many_colors},
      {"certified",
       "a bound is not passed anywhere",
       with_two_sources(),
       {1e-3, 3e-3, 1e-4},
       certified},
      {"tolerance_zero",
       "the most exact that there is",
       all_lights,
       {0},
       [](Random& random) { return any_base(random); }},
  };
}

}  // namespace splotchcl::adversary
