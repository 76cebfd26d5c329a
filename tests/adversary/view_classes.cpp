#include <functional>

#include "adversary/classes.h"
#include "adversary/starts.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

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

Trial footprint_of_pixels(Random& random) {
  Trial trial = any_base(random);
  trial.footprint = random.logarithmic(0.1, 2);
  if (random.uniform() < 0.5) trial.projection = Projection::perspective;
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

// Of a stereo pair in all directions, which turns near clouds far.
Trial eye_of_a_pair(Random& random) {
  constexpr Projection wide[] = {Projection::fisheye, Projection::equirectangular,
                                 Projection::cube};
  Trial trial = in_projection(wide[static_cast<int>(random.uniform(0, 3))], random);
  trial.eye = random.logarithmic(1e-3, 1);
  trial.left_eye = random.uniform() < 0.5 ? 1 : 0;
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

Trial wide_picture(Random& random) {
  Trial trial = bright_stars(random);
  trial.picture_size = random.uniform() < 0.5 ? 65536 : 32768;
  return trial;
}

Trial clouds_in_a_dome(Random& random) {
  Trial trial = clouds_around(random);
  trial.projection = Projection::fisheye;
  trial.dome = 1;
  trial.cut = random.logarithmic(0.03, 3);
  trial.field_of_view = random.uniform(1, 140);
  return trial;
}

Trial inset(Random& random) {
  Trial trial = any_base(random);
  trial.projection = random.uniform() < 0.7 ? Projection::perspective : Projection::fisheye;
  trial.inset = random.logarithmic(1e-3, 1);
  return trial;
}

// As .par files become scenes: docs/original-files.md.
Trial as_the_original(Random& random) {
  Trial trial = any_base(random);
  trial.original = 1;
  trial.sampling = Sampling::center;
  trial.cut = 1.8153;
  trial.min_radius = 0.5;
  trial.projection = Projection::perspective;
  return trial;
}

std::function<Trial(Random&)> seen_in(Projection projection) {
  return [projection](Random& random) { return in_projection(projection, random); };
}

}  // namespace

std::vector<TrialClass> view_classes() {
  return {
      {"large_picture", "places have the digits of the picture, not of what is drawn of it",
       all_lights, usual, large_picture},
      {"bright_stars", "errors of a place show as parts of a star's light", all_lights, usual,
       bright_stars},
      {"cut_kernel", "a cut edge is part of the picture, on coarse grids too", all_lights, usual,
       cut_kernel},
      {"center_values", "clouds below a pixel are drawn as they are at its centre", all_lights,
       usual, center_values},
      {"min_radius", "widths and weights change together", all_lights, usual, smallest_radius},
      {"footprint", "clouds below a pixel become wider ones, at their own light", all_lights, usual,
       footprint_of_pixels},
      {"crop", "what is drawn lies anywhere in its picture", all_lights, usual, crop_of_a_picture},
      {"perspective", "places are quotients", all_lights, usual, seen_in(Projection::perspective)},
      {"fisheye", "places are arcs", all_lights, usual, seen_in(Projection::fisheye)},
      {"equirectangular", "clouds are wider than high, and have copies", all_lights, usual,
       seen_in(Projection::equirectangular)},
      {"cube", "clouds grow towards a face's corners", all_lights, usual,
       seen_in(Projection::cube)},
      {"eye_of_a_pair", "clouds turn by angles that their distances give", all_lights, usual,
       eye_of_a_pair},
      {"clouds_around", "what rays find of clouds is smooth but for where they are cut", all_lights,
       usual, clouds_around},
      {"clouds_in_a_dome", "the same of cut ones in half of all directions and more", all_lights,
       usual, clouds_in_a_dome},
      {"inset", "clouds are wider than their picture, or far beside it", all_lights, usual, inset},
      {"original", "centers of pixels lie elsewhere, and edges are cut", all_lights, usual,
       as_the_original},
      {"wide_picture", "so wide a picture leaves few digits to places", all_lights, usual,
       wide_picture},
  };
}

}  // namespace splotchcl::adversary
