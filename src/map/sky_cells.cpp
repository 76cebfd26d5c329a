#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "cells/shares_on_the_sky.h"
#include "cells/sky_grid.h"
#include "cells/sky_lattice.h"
#include "map/cell_map.h"
#include "parallel/for_blocks.h"
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

  // Where wide particles have many cells together, they are summed up at points instead.
  void add_up() {
    sort_by_width();
    if (!pays_lattice()) take_all_as_narrow();
    add_narrow();
    std::vector<std::vector<double>> values;
    for (std::size_t level = 0; level < wide_.size(); ++level)
      values = with_level(static_cast<int>(level), std::move(values));
    if (!values.empty()) add_lattice(SkyLattice(static_cast<int>(wide_.size()) - 1), values);
  }

  // Of the weights, per solid angle.
  double floor() const { return floors_.front(); }
  std::size_t count() const { return images_.source.size(); }
  const CellSums& sums() const { return sums_; }

 private:
  // Numbers of images, and which particles they are of.
  struct Images {
    std::vector<std::size_t> image;
    std::vector<std::uint32_t> source;

    void add(std::size_t number, std::uint32_t of) {
      image.push_back(number);
      source.push_back(of);
    }
  };

  // What is narrower than a cell is not smooth enough for the rule of cells.
  void sort_by_width() {
    constexpr double cells_in_width = 1;
    const double cell = std::sqrt(grid_.solid_angle(grid_.cells() / 2));
    for (std::size_t image = 0; image < count(); ++image) {
      const GaussianOnSky particle = particle_of(image);
      const SkyAccuracy accuracy = accuracy_of(image, particle);
      const int level = SkyLattice::level_for(particle.width());
      const bool is_wide = particle.width() > cells_in_width * cell && is_small(level) &&
                           lattice_error < accuracy.tolerance * accuracy.floor;
      (is_wide ? of_level(level) : narrow_).add(image, images_.source[image]);
      if (is_wide) cells_of_wide_ += cells_within(reach_that_counts(particle, accuracy));
    }
  }

  // In memory, beside the cells.
  bool is_small(int level) const {
    constexpr std::size_t per_cell = 6, few = std::size_t{1} << 21, most = std::size_t{1} << 24;
    return SkyLattice::points_of(level) <= std::min(most, per_cell * grid_.cells() + few);
  }

  void take_all_as_narrow() {
    wide_.clear();
    narrow_ = {};
    for (std::size_t image = 0; image < count(); ++image)
      narrow_.add(image, images_.source[image]);
  }

  Images& of_level(int level) {
    const auto place = static_cast<std::size_t>(level);
    if (wide_.size() <= place) wide_.resize(place + 1);
    return wide_[place];
  }

  double cells_within(double reach) const {
    return 0.5 * (1 - std::cos(reach)) * static_cast<double>(grid_.cells());
  }

  // Each cell takes as long from the finest lattice as from so many particles; a lattice is about
  // the whole sky.
  bool pays_lattice() const {
    constexpr double particles = 6, points_of_cell = 16;
    if (wide_.empty()) return false;
    const auto cells = static_cast<double>(grid_.cells());
    const auto points =
        static_cast<double>(SkyLattice::points_of(static_cast<int>(wide_.size()) - 1));
    return cells_of_wide_ > particles * (cells + points / points_of_cell);
  }

  void add_up(const Images& images, const FindShares& find, const ExpectedShares& expected,
              CellSums& sums) {
    const auto all = static_cast<double>(count());
    const double before = done_, part = static_cast<double>(images.source.size()) / all;
    add_up_shares(
        amounts_, images.source, find, expected,
        [&](double done) {
          if (matter_.progress) matter_.progress(before + part * done);
        },
        sums);
    done_ += part;
  }

  void add_narrow() {
    if (narrow_.image.empty()) return;
    const auto find = [this](std::size_t i, std::vector<CellShare>& shares) {
      const GaussianOnSky particle = particle_of(narrow_.image[i]);
      add_shares_on_the_sky(grid_, particle, accuracy_of(narrow_.image[i], particle), shares);
    };
    const auto expected = [this](std::size_t i) {
      return 4 + cells_within(particle_of(narrow_.image[i]).reach());
    };
    add_up(narrow_, find, expected, sums_);
  }

  // Sums of wide particles at the points of a level, and of coarser ones, kind by kind.
  std::vector<std::vector<double>> with_level(int level, std::vector<std::vector<double>> coarser) {
    const Images& images = wide_[static_cast<std::size_t>(level)];
    const SkyLattice lattice(level);
    CellSums sums(amounts_.kinds(), lattice.points());
    for (std::size_t kind = 0; kind < coarser.size(); ++kind)
      sums.kinds[kind] = SkyLattice(level - 1).refined(coarser[kind]);
    const auto find = [&](std::size_t i, std::vector<CellShare>& values) {
      const GaussianOnSky particle = particle_of(images.image[i]);
      const double reach = reach_that_counts(particle, accuracy_of(images.image[i], particle));
      lattice.add_values(particle, reach, values);
    };
    const auto expected = [&](std::size_t i) {
      const double part = 0.5 * (1 - std::cos(particle_of(images.image[i]).reach()));
      return 4 + part * static_cast<double>(lattice.points());
    };
    if (!images.image.empty()) add_up(images, find, expected, sums);
    return std::move(sums.kinds);
  }

  // Of all wide particles together, to which each cell's integral is brought where there are all
  // cells.
  void add_lattice(const SkyLattice& lattice, const std::vector<std::vector<double>>& values) {
    CellSums added(amounts_.kinds(), grid_.cells());
    for (const SkyPatch& face : grid_.faces()) {
      const auto rows = static_cast<std::size_t>(face.height);
      for_blocks(rows, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
          add_row(lattice, values, face, static_cast<int>(row), added);
      });
    }
    const double scale = grid_.has_all_of_the_sky() ? wide_weight() / sum_of(added.kinds[0]) : 1;
    for (std::size_t kind = 0; kind < amounts_.kinds(); ++kind) {
      for (std::size_t cell = 0; cell < grid_.cells(); ++cell)
        sums_.kinds[kind][cell] += scale * added.kinds[kind][cell];
    }
  }

  void add_row(const SkyLattice& lattice, const std::vector<std::vector<double>>& values,
               const SkyPatch& face, int row, CellSums& added) const {
    for (int x = 0; x < static_cast<int>(face.width); ++x) {
      const SkyPatch cell = {face.face, static_cast<double>(x), static_cast<double>(row), 1, 1};
      const std::size_t number = grid_.cell(face.face, x, row);
      visit_points(grid_, cell, sky_rules.back(), [&](const Vec3& direction, double weight) {
        const SkyLattice::Stencil stencil = lattice.stencil_at(direction);
        for (std::size_t kind = 0; kind < values.size(); ++kind)
          added.kinds[kind][number] += weight * stencil.of(values[kind]);
      });
    }
  }

  double wide_weight() const {
    double weight = 0;
    for (const Images& images : wide_) {
      for (const std::uint32_t source : images.source)
        weight += amounts_(source, 0);
    }
    return weight;
  }

  static double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  }

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
  Images narrow_;
  std::vector<Images> wide_;  // by the level of their lattice
  double cells_of_wide_ = 0, done_ = 0;
};

}  // namespace

CellMap draw_sky(const CellMatter& matter, int width, int height) {
  const MapSettings& settings = matter.settings;
  const std::unique_ptr<SkyGrid> grid = grid_of(settings, width, height);
  const Amounts amounts(matter.quantity, matter.matter.count, matter.weight_unit,
                        [&](std::size_t i) { return matter.matter.is_good(i); });
  check_cells(static_cast<double>(grid->cells()), 2 * amounts.kinds(),
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
