#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "cells/healpix_grid.h"
#include "cells/picture_of_the_sky.h"
#include "cells/shares_on_the_sky.h"
#include "map/cell_map.h"
#include "map/cell_sums.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;
using SkyProjection = PictureOfTheSky::Projection;

// Wider pictures are no planes any more that touch the sky.
constexpr double widest_plane = 120;

SkyPlace place_on_sky(const MapSettings& settings, int width) {
  const double degrees = settings.width.value_or(360);
  const double radian = 180 / pi;
  if (degrees > 360) {
    throw UsageError(
        fmt::format("key map.width: found {} degrees of the sky, expected at most 360", degrees));
  }
  SkyPlace sky = {settings.sky[0], settings.sky[1], degrees / width, "CAR"};
  if (degrees > widest_plane) return sky;
  sky.projection = "TAN";
  sky.pixel = 2 * std::tan(0.5 * degrees / radian) * radian / width;
  return sky;
}

std::unique_ptr<SkyGrid> grid_of(const MapSettings& settings, int width, int height) {
  if (settings.healpix > 0)
    return std::make_unique<HealpixGrid>(settings.healpix, settings.healpix_order);
  const SkyPlace sky = place_on_sky(settings, width);
  const auto projection = sky.projection == "TAN" ? SkyProjection::tan : SkyProjection::car;
  return std::make_unique<PictureOfTheSky>(projection, width, height, sky.right_ascension,
                                           sky.declination, sky.pixel);
}

// What has its center in the shell: each particle once, or all images.
ImagesAround images_on_sky(const CellMatter& matter, const Amounts& amounts) {
  const MapSettings& settings = matter.settings;
  const std::array<double, 2> everywhere = {0, std::numeric_limits<double>::infinity()};
  const auto [low, high] = settings.shell.value_or(everywhere);
  if (settings.tile) check_images(high, matter.geometry.box, "key map.shell");
  ImagesAround images;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (!amounts.is_good(i)) continue;
    const Vec3 nearest = nearest_offset(matter, i);
    const std::vector<Vec3> places =
        settings.tile ? images_within(nearest, high, matter.geometry.box) : std::vector{nearest};
    for (const Vec3& place : places) {
      if (mag(place) >= low && mag(place) < high) images.add(place, i);
    }
  }
  return images;
}

class SkySums {
 public:
  SkySums(const CellMatter& matter, const SkyGrid& grid, const Amounts& amounts)
      : matter_(matter),
        grid_(grid),
        amounts_(amounts),
        images_(images_on_sky(matter, amounts)),
        sums_(amounts.kinds(), grid.cells()) {
    for (std::size_t kind = 0; kind < amounts.kinds(); ++kind)
      floors_.push_back(matter.settings.floor * total(kind) / (4 * pi));
  }

  void add_up() {
    const auto find = [this](std::size_t image, std::vector<CellShare>& shares) {
      const GaussianOnSky particle = particle_of(image);
      add_shares_on_the_sky(grid_, particle, accuracy_of(image, particle), shares);
    };
    const auto expected = [this](std::size_t image) {
      const double part = 0.5 * (1 - std::cos(particle_of(image).reach()));
      return 4 + part * static_cast<double>(grid_.cells());
    };
    add_up_shares(amounts_, images_.source, find, expected, matter_.progress, sums_);
  }

  // Of the weights, per solid angle.
  double floor() const { return floors_.front(); }
  std::size_t count() const { return images_.source.size(); }
  const CellSums& sums() const { return sums_; }

 private:
  double total(std::size_t kind) const {
    double sum = 0;
    for (const std::uint32_t source : images_.source)
      sum += std::abs(amounts_(source, kind));
    return sum;
  }
  GaussianOnSky particle_of(std::size_t image) const {
    return {images_.offset[image], matter_.sigma * matter_.matter.size_of(images_.source[image])};
  }
  // A part of what is promised, since the error of a rule for integrals is an estimate.
  SkyAccuracy accuracy_of(std::size_t image, const GaussianOnSky& particle) const {
    constexpr double part = 0.25, least = 1e-9;
    SkyAccuracy accuracy = {std::max(part * matter_.tolerance, least),
                            std::numeric_limits<double>::infinity()};
    const double peak = particle(particle.middle());
    for (std::size_t kind = 0; kind < amounts_.kinds(); ++kind) {
      const double amount = std::abs(amounts_(images_.source[image], kind));
      if (amount > 0) accuracy.floor = std::min(accuracy.floor, floors_[kind] / (amount * peak));
    }
    return accuracy;
  }

  const CellMatter& matter_;
  const SkyGrid& grid_;
  const Amounts& amounts_;
  ImagesAround images_;
  CellSums sums_;
  std::vector<double> floors_;
};

}  // namespace

CellMap draw_sky(const CellMatter& matter, int width, int height) {
  const MapSettings& settings = matter.settings;
  const std::unique_ptr<SkyGrid> grid = grid_of(settings, width, height);
  const Amounts amounts(matter.quantity, matter.matter.count, matter.weight_unit,
                        [&](std::size_t i) { return matter.matter.is_good(i); });
  check_cells(static_cast<double>(grid->cells()), amounts.kinds(),
              settings.healpix > 0 ? "key map.healpix" : "key image.size");
  SkySums sums(matter, *grid, amounts);
  sums.add_up();

  CellMap map;
  map.floor = sums.floor();
  const double mean_size = 4 * pi / static_cast<double>(grid->cells());
  if (amounts.kind() == MapQuantity::Kind::column) map.value_floor = map.floor;
  if (amounts.kind() == MapQuantity::Kind::counts) map.value_floor = map.floor * mean_size;
  map.values = values_of(
      sums.sums(), amounts, [&grid](std::size_t cell) { return grid->solid_angle(cell); },
      map.floor);
  map.width = static_cast<int>(grid->cells());
  map.height = 1;
  if (settings.healpix > 0) {
    map.healpix = HealpixPixels{settings.healpix, settings.healpix_order};
  } else {
    map.width = width;
    map.height = height;
    map.sky = place_on_sky(settings, width);
  }
  map.shell = settings.shell;
  map.images = sums.count();
  map.bad = amounts.bad();
  return map;
}

}  // namespace splotchcl
