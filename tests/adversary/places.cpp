#include "adversary/places.h"

#include "device/scenes.h"
#include "testing.h"

namespace splotchcl::adversary {

int whole(double value) {
  return static_cast<int>(std::lround(value));
}

Rectangle crop_of(const Trial& trial) {
  const int width = whole(trial.width), height = whole(trial.height);
  const int beside_x = std::max(whole(trial.picture_size) - width, 0);
  const int beside_y = std::max(whole(trial.picture_size) - height, 0);
  return {whole(trial.crop_x * beside_x), whole(trial.crop_y * beside_y), width, height};
}

namespace {

using test::Random;

// The side of the square cells, two sizes for each factor of two, that the search for crowds
// collects clouds of this width in.
double side_of_cell(double sigma) {
  return std::exp2(0.5 * std::floor(2 * std::log2(std::max(sigma, 1.0))));
}

// Where a group's places lie, from its middle, in pixels.
class Layout {
 public:
  Layout(const CloudGroup& group, const Trial& trial, Random& random)
      : group_(group), trial_(trial), random_(random) {}

  int count() const {
    const int places = std::max(whole(group_.places), 1);
    switch (group_.arrangement) {
      case Arrangement::corner:
        return 4;
      case Arrangement::lattice:
        return side() * side();
      case Arrangement::sheet:
        return columns() * rows();
      default:
        return places;
    }
  }

  std::pair<double, double> place(int i, double sigma) {
    const int count = this->count();
    switch (group_.arrangement) {
      case Arrangement::point:
        return {0, 0};
      case Arrangement::ring: {
        const double angle = 2 * pi * (i + 0.25) / count, radius = group_.spread * sigma;
        return {radius * std::cos(angle), radius * std::sin(angle)};
      }
      case Arrangement::line:
        return {group_.spread * group_.sigma * (i - 0.5 * (count - 1)), 0};
      case Arrangement::lattice:
        return in_grid(i, side(), side());
      case Arrangement::sheet:
        return in_grid(i, columns(), rows());
      case Arrangement::corner:
        return {i % 2 == 0 ? -0.01 : 0.01, i < 2 ? -0.01 : 0.01};
      case Arrangement::scatter:
        return {random_.uniform(-0.6, 0.6) * trial_.width,
                random_.uniform(-0.6, 0.6) * trial_.height};
    }
    return {0, 0};
  }

 private:
  int side() const {
    return std::max(1, static_cast<int>(std::sqrt(std::max(group_.places, 1.0))));
  }
  // A sheet reaches three sigma beyond the picture on each side, with not more clouds than are
  // drawn soon.
  double extent(double pixels) const { return pixels + 6 * group_.sigma; }
  double spacing() const {
    const double spacing = std::max(group_.spread * group_.sigma, 0.2);
    if (group_.arrangement != Arrangement::sheet) return spacing;
    constexpr double most_in_a_row = 60;
    return std::max(spacing, extent(std::max(trial_.width, trial_.height)) / most_in_a_row);
  }
  int across(double pixels) const { return std::max(whole(extent(pixels) / spacing()), 1); }
  int columns() const { return across(trial_.width); }
  int rows() const { return across(trial_.height); }
  std::pair<double, double> in_grid(int i, int columns, int rows) const {
    return {spacing() * (i % columns - 0.5 * (columns - 1)),
            spacing() * (i / columns - 0.5 * (rows - 1))};
  }

  const CloudGroup& group_;
  const Trial& trial_;
  Random& random_;
};

void add_places(const CloudGroup& group, const Trial& trial, std::uint64_t seed,
                std::vector<Place>& places) {
  Random random(seed);
  const Rectangle crop = crop_of(trial);
  double middle_x = crop.x + 0.5 * crop.width + group.x;
  double middle_y = crop.y + 0.5 * crop.height + group.y;
  if (group.arrangement == Arrangement::corner) {
    const double side = side_of_cell(group.sigma);
    middle_x = std::round(middle_x / side) * side;
    middle_y = std::round(middle_y / side) * side;
  }
  Layout layout(group, trial, random);
  const int count = layout.count();
  for (int i = 0; i < count; ++i) {
    Place place;
    const double part = count > 1 ? static_cast<double>(i) / (count - 1) : 0;
    place.sigma = group.sigma * std::pow(group.width_range, part);
    const auto [x, y] = layout.place(i, place.sigma);
    const double jitter = group.jitter * place.sigma;
    place.x = middle_x + x + jitter * random.uniform(-1, 1);
    place.y = middle_y + y + jitter * random.uniform(-1, 1);
    place.depth = group.depth * random.uniform(1, 1.2);
    place.copies = std::max(whole(group.copies), 1);
    place.group = &group;
    places.push_back(place);
  }
}

}  // namespace

std::vector<Place> places_of(const Trial& trial) {
  std::vector<Place> places;
  std::uint64_t seed = 100 * static_cast<std::uint64_t>(std::max(trial.jitter_seed, 0.0));
  for (const CloudGroup& group : trial.groups)
    add_places(group, trial, ++seed, places);
  return places;
}

}  // namespace splotchcl::adversary
