#include "adversary/classes.h"
#include "adversary/starts.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

// Each 13th of 2e5 particles is looked at by a sample of 16384.
constexpr double file = 2e5, stride = 13;

// Wide and narrow clouds behind one another, so dim that their order shows little.
Trial slabs(Random& random) {
  std::vector<CloudGroup> groups;
  const int count = static_cast<int>(whole(random, 2, 5));
  for (int i = 0; i < count; ++i) {
    const Arrangement arrangement = random.uniform() < 0.5   ? Arrangement::point
                                    : random.uniform() < 0.5 ? Arrangement::scatter
                                                             : Arrangement::sheet;
    const bool is_wide = random.uniform() < 0.6;
    CloudGroup group =
        group_of(arrangement, random, is_wide ? 4 : 0.5, is_wide ? 30 : 4, 1e-4, 0.1);
    group.places = whole(random, 1, 20);
    group.copies = whole(random, 1, 50);
    groups.push_back(group);
  }
  Trial trial = with(groups);
  trial.slabs = whole(random, 1, 8);
  return trial;
}

Trial crowd_in_ring(Random& random) {
  CloudGroup middle = group_of(Arrangement::point, random, 1.5, 8, 1, 1e3);
  middle.copies = whole(random, 24, 100);
  CloudGroup ring = middle;
  ring.arrangement = Arrangement::ring;
  ring.places = whole(random, 2, 16);
  ring.spread = random.uniform(1.5, 4);
  return with({middle, ring});
}

Trial mixed_widths(Random& random) {
  std::vector<CloudGroup> groups;
  for (int i = 0; i < 4; ++i) {
    CloudGroup group = group_of(Arrangement::point, random, 1, 20, 0.3, 100);
    group.x = group.y = 3.3;
    group.copies = whole(random, 1, 23);
    groups.push_back(group);
  }
  return with(groups);
}

Trial period_in_file(Random& random) {
  CloudGroup group = group_of(Arrangement::point, random, 0.7, 10, 0.1, 3);
  group.copies = whole(random, 1000, 10000);
  Trial trial = with({group});
  trial.filler = file - group.copies;
  trial.period = stride;
  trial.offset = std::floor(random.uniform(1, stride));
  return trial;
}

Trial lone_star_of_a_file(Random& random) {
  CloudGroup group = group_of(Arrangement::point, random, 0.4, 3, 10, 1e5);
  Trial trial = with({group});
  trial.filler = file - 1;
  trial.period = stride;
  trial.offset = std::floor(random.uniform(1, stride));
  return trial;
}

Trial beside_picture(Random& random) {
  CloudGroup group = group_of(Arrangement::point, random, 2, 15, 1, 1e6);
  group.copies = whole(random, 1, 400);
  group.x = 32 + random.uniform(2, 6) * group.sigma;
  return with({group});
}

Trial coarse_levels(Random& random) {
  CloudGroup group = group_of(random.uniform() < 0.5 ? Arrangement::point : Arrangement::line,
                              random, 20, 400, 0.1, 20);
  group.places = whole(random, 1, 20);
  group.copies = whole(random, 1, 23);
  group.spread = random.uniform(0.5, 6);
  group.width_range = random.uniform(1, 4);
  Trial trial = with({group});
  trial.width = 1024;
  trial.height = 32;
  return trial;
}

Trial thin_layers(Random& random) {
  CloudGroup group = group_of(Arrangement::point, random, 2, 30, 1e-4, 1e-2);
  group.places = whole(random, 5, 100);
  group.copies = whole(random, 20, 400);
  group.width_range = random.uniform(1, 2);
  Trial trial = with({group});
  trial.background = random.logarithmic(1, 1e4);
  trial.source = random.logarithmic(0.01, 100);
  return trial;
}

// So many particles, wide and dim, that slabs seem to pay.
Trial chosen_slabs(Random& random) {
  CloudGroup wide = group_of(Arrangement::scatter, random, 8, 30, 1e-5, 3e-4);
  wide.places = whole(random, 8, 20);
  wide.copies = whole(random, 200, 400);
  CloudGroup narrow = group_of(Arrangement::scatter, random, 0.5, 4, 1e-4, 1e-2);
  narrow.places = whole(random, 1, 50);
  Trial trial = with({wide, narrow});
  trial.source = random.logarithmic(0.005, 0.05);
  trial.filler = 530000;
  return trial;
}

}  // namespace

std::vector<TrialClass> cloud_classes() {
  return {
      {"few_bright_clouds", "errors of coarse grids are parts of a peak, and land where it is dark",
       sums, usual, few_bright},
      {"crowd", "many clouds end in the same pixels", all_lights, usual, crowd},
      {"corner_of_cells", "a crowd that four cells share is none in any of them", all_lights, usual,
       corner},
      {"crowds_in_rings", "around a crowd it is only bright because of other crowds", all_lights,
       usual, crowd_in_ring},
      {"ring", "clouds around a dark pixel all end in it, without being a crowd anywhere",
       all_lights, usual, ring},
      {"ring_before_sheet", "the same before even light", all_lights, usual, ring_before_sheet},
      {"lattice", "a grid of initial conditions seen along an axis", all_lights, usual, lattice},
      {"line", "squares that end in the same row of pixels", all_lights, usual, line},
      {"mixed_widths", "a crowd that has a few clouds of each width", all_lights, usual,
       mixed_widths},
      {"sheets", "even light of several widths, and a few clouds in it", all_lights, usual, sheets},
      {"period_in_file",
       "a sample of each n-th particle meets none of a crowd",
       {Light::proportional, Light::emission},
       usual,
       period_in_file},
      {"lone_star_of_a_file",
       "one sharp star that is in no sample",
       {Light::emission, Light::proportional},
       {1e-4, 1e-3, 1e-5},
       lone_star_of_a_file},
      {"thin_layers",
       "each of very many layers errs by a rounding",
       {Light::ordered, Light::proportional, Light::stars_among_gas, Light::gray},
       usual,
       thin_layers},
      {"beside_picture", "clouds whose centres lie outside, and whose light does not", all_lights,
       usual, beside_picture},
      {"coarse_levels", "what one grid errs by the next ones interpolate", sums, usual,
       coarse_levels},
      {"slabs",
       "wide clouds are laid among narrow ones in no order",
       {Light::ordered, Light::gray, Light::stars_among_gas},
       {1e-3, 1e-2},
       slabs},
      {"chosen_slabs",
       "the same of so many that the plan chooses slabs",
       {Light::ordered},
       {1e-3, 1e-2},
       chosen_slabs},
  };
}

}  // namespace splotchcl::adversary
