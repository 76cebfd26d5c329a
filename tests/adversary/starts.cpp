#include "adversary/starts.h"

#include "testing.h"

namespace splotchcl::adversary {

using test::Random;

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

Trial sheets(Random& random) {
  CloudGroup wide = even_sheet(random, 0.3, 10);
  wide.sigma *= 3;
  CloudGroup star = group_of(Arrangement::point, random, 0.5, 10, 0.1, 100);
  return with({even_sheet(random, 0.01, 10), wide, star});
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

}  // namespace splotchcl::adversary
