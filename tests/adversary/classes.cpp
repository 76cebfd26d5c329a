#include "adversary/classes.h"

#include <cmath>

namespace splotchcl::adversary {
namespace {

using test::Random;

const std::vector<Light> all_lights = {Light::proportional, Light::ordered, Light::emission,
                                       Light::factor,       Light::gray,    Light::stars_among_gas};
const std::vector<Light> sums = {Light::proportional, Light::emission, Light::factor};
const std::vector<double> usual = {1e-3, 1e-2, 1e-4, 1e-5};

double whole(Random& random, double low, double high) {
  return std::floor(random.logarithmic(low, high + 1));
}

Trial with(std::vector<CloudGroup> groups) {
  Trial trial;
  trial.groups = std::move(groups);
  return trial;
}

CloudGroup group_of(Arrangement arrangement, Random& random, double sigma_low, double sigma_high,
                    double peak_low, double peak_high) {
  CloudGroup group;
  group.arrangement = arrangement;
  group.x = random.uniform(-20, 20);
  group.y = random.uniform(-15, 15);
  group.sigma = random.logarithmic(sigma_low, sigma_high);
  group.peak = random.logarithmic(peak_low, peak_high);
  group.hue = random.uniform();
  group.depth = random.logarithmic(1, 100);
  if (random.uniform() < 0.2) group.star = 1;
  return group;
}

CloudGroup even_sheet(Random& random, double light_low, double light_high) {
  CloudGroup sheet = group_of(Arrangement::sheet, random, 1, 8, 0, 0);
  sheet.x = sheet.y = 0;
  sheet.spread = random.uniform(0.6, 1.2);
  sheet.peak = random.logarithmic(light_low, light_high) * sheet.spread * sheet.spread / pi;
  return sheet;
}

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

Trial few_bright(Random& random) {
  CloudGroup group = group_of(Arrangement::point, random, 3, 45, 0.5, 20);
  group.copies = whole(random, 1, 23);
  return with({group});
}

Trial crowd(Random& random) {
  CloudGroup group = group_of(Arrangement::point, random, 0.5, 20, 0.1, 1e3);
  group.copies = whole(random, 24, 400);
  return with({group});
}

Trial corner(Random& random) {
  CloudGroup group = group_of(Arrangement::corner, random, 0.7, 12, 1, 1e3);
  group.copies = whole(random, 10, 23);
  return with({group});
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

Trial ring(Random& random) {
  CloudGroup group = group_of(Arrangement::ring, random, 0.7, 12, 0.01, 30);
  group.places = whole(random, 4, 200);
  group.copies = whole(random, 1, 23);
  group.spread = random.uniform(2, 4.5);
  group.width_range = random.uniform() < 0.5 ? 1 : random.uniform(1, 3);
  return with({group});
}

Trial ring_before_sheet(Random& random) {
  Trial trial = ring(random);
  trial.groups.push_back(even_sheet(random, 0.3, 100));
  return trial;
}

Trial lattice(Random& random) {
  CloudGroup group = group_of(Arrangement::lattice, random, 0.7, 12, 0.01, 10);
  group.places = whole(random, 4, 200);
  group.copies = whole(random, 1, 100);
  group.spread = random.uniform(0.6, 6);
  return with({group});
}

Trial line(Random& random) {
  CloudGroup group = group_of(Arrangement::line, random, 0.7, 15, 0.01, 30);
  group.places = whole(random, 4, 200);
  group.copies = whole(random, 1, 23);
  group.spread = random.logarithmic(0.05, 1);
  return with({group});
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

Trial sheets(Random& random) {
  CloudGroup wide = even_sheet(random, 0.3, 10);
  wide.sigma *= 3;
  CloudGroup star = group_of(Arrangement::point, random, 0.5, 10, 0.1, 100);
  return with({even_sheet(random, 0.01, 10), wide, star});
}

Trial vector_colors(Random& random) {
  Trial trial = random.uniform() < 0.5 ? crowd(random) : few_bright(random);
  trial.own_colors = 1;
  for (CloudGroup& group : trial.groups)
    group.color = random.logarithmic(1, 1e4);
  return trial;
}

// Each 13th of 2e5 particles is looked at by a sample of 16384.
constexpr double file = 2e5, stride = 13;

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

Trial large_picture(Random& random) {
  Trial trial = with({group_of(Arrangement::scatter, random, 0.4, 4, 0.5, 20)});
  trial.groups.front().places = whole(random, 1, 50);
  trial.picture_size = 16384;
  trial.crop_x = random.uniform();
  trial.crop_y = random.uniform();
  if (random.uniform() < 0.5) trial.projection = Projection::perspective;
  return trial;
}

Trial bright_stars(Random& random) {
  Trial trial = with({group_of(Arrangement::scatter, random, 0.4, 4, 30, 1e6)});
  trial.groups.front().places = whole(random, 1, 20);
  trial.picture_size = 1400;
  trial.crop_x = random.uniform();
  trial.crop_y = random.uniform();
  return trial;
}

Trial opaque_before_bright(Random& random) {
  CloudGroup near_group = group_of(Arrangement::point, random, 3, 30, 0.1, 30);
  near_group.copies = whole(random, 1, 30);
  near_group.depth = 1;
  near_group.star = 0;
  CloudGroup far_group = group_of(Arrangement::scatter, random, 0.5, 20, 1, 1e5);
  far_group.places = whole(random, 1, 50);
  far_group.depth = 50;
  far_group.star = 1;
  Trial trial = with({near_group, far_group});
  trial.source = random.logarithmic(0.01, 100);
  if (random.uniform() < 0.7) trial.background = random.logarithmic(0.1, 1e4);
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

Trial any_base(Random& random) {
  switch (static_cast<int>(random.uniform(0, 8))) {
    case 0:
      return few_bright(random);
    case 1:
      return crowd(random);
    case 2:
      return corner(random);
    case 3:
      return ring_before_sheet(random);
    case 4:
      return lattice(random);
    case 5:
      return line(random);
    case 6:
      return sheets(random);
    default:
      return opaque_before_bright(random);
  }
}

Trial cut_kernel(Random& random) {
  Trial trial = any_base(random);
  trial.cut = random.uniform(1.2, 3.5);
  if (random.uniform() < 0.5) trial.sampling = Sampling::center;
  return trial;
}

Trial center_values(Random& random) {
  Trial trial = any_base(random);
  trial.sampling = Sampling::center;
  return trial;
}

Trial smallest_radius(Random& random) {
  Trial trial = any_base(random);
  trial.min_radius = random.logarithmic(0.2, 3);
  return trial;
}

Trial in_projection(Projection projection, Random& random) {
  Trial trial = any_base(random);
  trial.projection = projection;
  if (projection == Projection::cube) trial.width = trial.height;
  if (projection == Projection::equirectangular) trial.height = 0.5 * trial.width;
  if (projection == Projection::fisheye) trial.field_of_view = random.uniform(40, 150);
  return trial;
}

Trial crop_of_a_picture(Random& random) {
  Trial trial = any_base(random);
  constexpr double sizes[] = {256, 1400, 4096, 16384};
  trial.picture_size = sizes[static_cast<int>(random.uniform(0, 4))];
  trial.crop_x = random.uniform();
  trial.crop_y = random.uniform();
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

// Clouds so near that rays find a part of them.
Trial clouds_around(Random& random) {
  Trial trial = any_base(random);
  trial.around = 1;
  trial.projection = random.uniform() < 0.7 ? Projection::perspective : Projection::fisheye;
  if (random.uniform() < 0.5) trial.cut = random.logarithmic(0.03, 3);
  trial.field_of_view = random.uniform(40, 90);
  for (CloudGroup& group : trial.groups) {
    group.sigma = random.logarithmic(3, 20);
    group.peak = random.logarithmic(1e-2, 10);
  }
  return trial;
}

Trial wide_picture(Random& random) {
  Trial trial = bright_stars(random);
  trial.picture_size = random.uniform() < 0.5 ? 65536 : 32768;
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

Trial certified(Random& random) {
  const auto choice = static_cast<int>(random.uniform(0, 6));
  Trial trial = choice == 0   ? two_sources(random)
                : choice == 1 ? tinted_matter(random)
                : choice == 2 ? many_colors(random)
                : choice == 3 ? cut_kernel(random)
                              : any_base(random);
  trial.certify = 1;
  return trial;
}

std::function<Trial(Random&)> seen_in(Projection projection) {
  return [projection](Random& random) { return in_projection(projection, random); };
}

}  // namespace

namespace {
std::vector<Light> with_two_sources() {
  std::vector<Light> lights = all_lights;
  lights.push_back(Light::two_sources);
  return lights;
}
}  // namespace

const std::vector<TrialClass>& all_classes() {
  static const std::vector<TrialClass> classes = {
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
      {"vector_colors", "a search that looks at palettes sees nothing of own colors", all_lights,
       usual, vector_colors},
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
      {"large_picture", "places have the digits of the picture, not of what is drawn of it",
       all_lights, usual, large_picture},
      {"bright_stars", "errors of a place show as parts of a star's light", all_lights, usual,
       bright_stars},
      {"opaque_before_bright",
       "what shines through has the digits of the transmittance",
       {Light::stars_among_gas, Light::ordered, Light::gray, Light::factor},
       usual,
       opaque_before_bright},
      {"thin_layers",
       "each of very many layers errs by a rounding",
       {Light::ordered, Light::proportional, Light::stars_among_gas, Light::gray},
       usual,
       thin_layers},
      {"beside_picture", "clouds whose centres lie outside, and whose light does not", all_lights,
       usual, beside_picture},
      {"coarse_levels", "what one grid errs by the next ones interpolate", sums, usual,
       coarse_levels},
      {"background", "light behind clouds is dimmed by what they lose", all_lights, usual,
       with_background},
      {"cut_kernel", "a cut edge is part of the picture, on coarse grids too", all_lights, usual,
       cut_kernel},
      {"center_values", "clouds below a pixel are drawn as they are at its centre", all_lights,
       usual, center_values},
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
      {"many_colors", "places in a palette are rounded", all_lights, usual, many_colors},
      {"clouds_around", "what rays find of clouds is smooth but for where they are cut", all_lights,
       usual, clouds_around},
      {"wide_picture", "so wide a picture leaves few digits to places", all_lights, usual,
       wide_picture},
      {"certified",
       "a bound is not passed anywhere",
       with_two_sources(),
       {1e-3, 3e-3, 1e-4},
       certified},
      {"min_radius", "widths and weights change together", all_lights, usual, smallest_radius},
      {"crop", "what is drawn lies anywhere in its picture", all_lights, usual, crop_of_a_picture},
      {"perspective", "places are quotients", all_lights, usual, seen_in(Projection::perspective)},
      {"fisheye", "places are arcs", all_lights, usual, seen_in(Projection::fisheye)},
      {"equirectangular", "clouds are wider than high, and have copies", all_lights, usual,
       seen_in(Projection::equirectangular)},
      {"cube", "clouds grow towards a face's corners", all_lights, usual,
       seen_in(Projection::cube)},
      {"tolerance_zero",
       "the most exact that there is",
       all_lights,
       {0},
       [](Random& random) { return any_base(random); }},
  };
  return classes;
}

Trial start_of(const TrialClass& kind, std::uint64_t seed, Random& random) {
  Trial trial = kind.start(random);
  trial.kind = kind.name;
  if (kind.lights.empty()) return trial;
  trial.light = kind.lights[seed % kind.lights.size()];
  trial.tolerance = kind.tolerances[seed / kind.lights.size() % kind.tolerances.size()];
  trial.turned = seed % 3 != 1 ? 1 : 0;
  if (seed % 5 == 4) trial.shape = CompositeShape::groups;
  return trial;
}

}  // namespace splotchcl::adversary
