#include "map/cell_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <limits>

#include "cells/gaussian.h"
#include "cells/shares_on_the_sky.h"
#include "map/map_units.h"
#include "parallel/available_memory.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"
#include "splotchcl/error.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

Vec3 nearest_offset(const CellMatter& matter, std::size_t i) {
  const MapGeometry& geometry = matter.geometry;
  Vec3 offset = matter.matter.position_of(i) - geometry.center;
  for (std::size_t axis = 0; axis < 3 && geometry.box; ++axis)
    offset.a[axis] = nearest_image(offset.a[axis], (*geometry.box)[axis]);
  return offset;
}

void check_cells(double cells, std::size_t kinds, const std::string& what) {
  // Sums, values, and these in single precision as they are and as they are written.
  const double bytes = cells * (8.0 * static_cast<double>(kinds) + 8 + 3 * 4);
  const auto available = static_cast<double>(available_memory());
  constexpr double gigabyte = 1e9, most_cells = 4e9;
  if (bytes <= available && cells <= most_cells) return;
  throw UsageError(fmt::format(
      "{}: {:.4g} cells take {:.3g} GB of memory, expected at most {:.3g} GB, which are available",
      what, cells, bytes / gigabyte, available / gigabyte));
}

Amounts::Amounts(const MapQuantity& quantity, std::size_t count, double unit,
                 const std::function<bool(std::size_t)>& is_good)
    : quantity_(quantity), unit_(unit), is_good_(count) {
  using Kind = MapQuantity::Kind;
  if (quantity.kind == Kind::mean) kinds_ = 2;
  if (quantity.kind == Kind::dispersion) kinds_ = 3;
  double weights = 0, values = 0;
  for (std::size_t i = 0; i < count; ++i) {
    is_good_[i] = is_good(i) && quantity.is_good(i);
    if (!is_good_[i]) ++bad_;
    if (kinds_ < 3 || !is_good_[i]) continue;
    weights += weight_of(i);
    values += weight_of(i) * static_cast<double>(quantity.value[i]);
  }
  if (weights > 0) middle_ = values / weights;
  totals_.resize(kinds_);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t kind = 0; kind < kinds_; ++kind)
      totals_[kind] += std::abs((*this)(i, kind));
  }
}

double Amounts::weight_of(std::size_t i) const {
  return unit_ * static_cast<double>(quantity_.weight[i]);
}

double Amounts::value_of(std::size_t i) const {
  return static_cast<double>(quantity_.value[i]) - middle_;
}

double Amounts::operator()(std::size_t i, std::size_t kind) const {
  if (!is_good_[i]) return 0;
  double amount = weight_of(i);
  for (std::size_t power = 0; power < kind; ++power)
    amount *= value_of(i);
  return amount;
}

CellSums::CellSums(std::size_t kind_count, std::size_t cells)
    : kinds(kind_count, std::vector<double>(cells, 0.0)) {}

namespace {

void add(const Amounts& amounts, std::size_t particle, const CellShare* first,
         const CellShare* last, CellSums& sums) {
  for (std::size_t kind = 0; kind < amounts.kinds(); ++kind) {
    const double amount = amounts(particle, kind);
    for (const CellShare* share = first; share != last; ++share)
      sums.kinds[kind][share->cell] += amount * share->part;
  }
}

// Particles that follow each other, and where the shares of each begin.
struct BlockOfShares {
  std::vector<CellShare> shares;
  std::vector<std::size_t> begins;
};

}  // namespace

void add_up_shares(const Amounts& amounts, const std::vector<std::uint32_t>& source,
                   const FindShares& find, const ExpectedShares& expected,
                   const std::function<void(double)>& progress, CellSums& sums) {
  constexpr std::size_t most_particles = 65536, block_size = 64;
  constexpr double most_shares = 1 << 22;  // what is held at a time, unless one has more
  const std::size_t count = source.size();
  for (std::size_t first = 0; first < count;) {
    std::size_t last = first;
    double shares = 0;
    while (last < count && last - first < most_particles &&
           (last == first || shares + expected(last) <= most_shares))
      shares += expected(last++);
    std::vector<BlockOfShares> blocks((last - first + block_size - 1) / block_size);
    for_blocks(last - first, block_size, [&](std::size_t from, std::size_t to) {
      BlockOfShares& block = blocks[from / block_size];
      for (std::size_t i = first + from; i < first + to; ++i) {
        block.begins.push_back(block.shares.size());
        find(i, block.shares);
      }
      block.begins.push_back(block.shares.size());
    });
    for (std::size_t i = first; i < last; ++i) {
      const BlockOfShares& block = blocks[(i - first) / block_size];
      const CellShare* const begin = block.shares.data();
      const std::size_t in_block = (i - first) % block_size;
      add(amounts, source[i], begin + block.begins[in_block], begin + block.begins[in_block + 1],
          sums);
    }
    first = last;
    if (progress) progress(static_cast<double>(first) / static_cast<double>(count));
  }
}

std::vector<double> values_of(const CellSums& sums, const Amounts& amounts,
                              const std::function<double(std::size_t)>& size, double floor) {
  using Kind = MapQuantity::Kind;
  const std::vector<double>& weight = sums.kinds[0];
  std::vector<double> values(weight.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (!(size(cell) > 0)) continue;
    if (amounts.kind() == Kind::counts) values[cell] = weight[cell];
    if (amounts.kind() == Kind::column) values[cell] = weight[cell] / size(cell);
    if (amounts.kinds() == 1 || !(weight[cell] > 0) || weight[cell] < floor * size(cell)) continue;
    const double mean = sums.kinds[1][cell] / weight[cell];
    values[cell] = mean + amounts.middle();
    if (amounts.kinds() < 3) continue;
    // Rounding may leave a hair below 0 where all values are the same.
    values[cell] = std::sqrt(std::max(0.0, sums.kinds[2][cell] / weight[cell] - mean * mean));
  }
  return values;
}

namespace {

// The particles of one of the fields, and its bins.
struct BinnedField {
  Column values;
  MapAxis axis;

  double at(std::size_t i) const { return static_cast<double>(values[i]); }
  // None outside of them.
  std::optional<int> bin_of(std::size_t i) const {
    const double value = at(i);
    if (!(value >= axis.first && value <= axis.last)) return std::nullopt;
    const double part = axis.is_logarithmic
                            ? std::log(value / axis.first) / std::log(axis.last / axis.first)
                            : (value - axis.first) / (axis.last - axis.first);
    return std::clamp(static_cast<int>(part * axis.cells), 0, axis.cells - 1);
  }
};

std::array<double, 2> range_of(const BinnedField& field, const Amounts& amounts,
                               std::size_t count) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < count; ++i) {
    if (!amounts.is_good(i)) continue;
    low = std::min(low, field.at(i));
    high = std::max(high, field.at(i));
  }
  if (!(low <= high)) return {1, 10};
  if (low < high) return {low, high};
  // All have one value.
  return low == 0 ? std::array<double, 2>{-0.5, 0.5}
                  : std::array<double, 2>{low - 0.5 * std::abs(low), low + 0.5 * std::abs(low)};
}

// Logarithmic where no value is 0 or below.
void set_range(const CellMatter& matter, const Amounts& amounts,
               const std::optional<std::array<double, 2>>& said, const char* key,
               BinnedField& field) {
  const std::array<double, 2> range = said ? *said : range_of(field, amounts, matter.matter.count);
  if (!(range[1] > range[0])) {
    throw UsageError(
        fmt::format("key {}: found {} to {}, expected a rising range", key, range[0], range[1]));
  }
  field.axis.first = range[0];
  field.axis.last = range[1];
  field.axis.is_logarithmic = range[0] > 0;
}

BinnedField read_field(const CellMatter& matter, const ComponentFields& fields, int type,
                       std::size_t which) {
  const MapSettings& settings = matter.settings;
  const std::string& name = settings.histogram[which];
  BinnedField field;
  field.values = fields.scalars(name, "map.histogram");
  field.axis.name = name;
  field.axis.unit = unit_of_field(name, settings, fields.snapshot_info(), type);
  field.axis.cells = settings.bins[which];
  return field;
}

}  // namespace

CellMap draw_histogram(const CellMatter& matter, const ComponentFields& fields, int type) {
  BinnedField x = read_field(matter, fields, type, 0), y = read_field(matter, fields, type, 1);
  const Amounts amounts(
      matter.quantity, matter.matter.count, matter.weight_unit,
      [&](std::size_t i) { return std::isfinite(x.at(i)) && std::isfinite(y.at(i)); });
  set_range(matter, amounts, matter.settings.x_range, "map.x_range", x);
  set_range(matter, amounts, matter.settings.y_range, "map.y_range", y);
  const auto width = static_cast<std::size_t>(x.axis.cells),
             height = static_cast<std::size_t>(y.axis.cells);
  CellSums sums(amounts.kinds(), width * height);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (!amounts.is_good(i)) continue;
    const auto column = x.bin_of(i), row = y.bin_of(i);
    if (!column || !row) {
      ++outside;
      continue;
    }
    const std::size_t cell =
        (height - 1 - static_cast<std::size_t>(*row)) * width + static_cast<std::size_t>(*column);
    for (std::size_t kind = 0; kind < amounts.kinds(); ++kind)
      sums.kinds[kind][cell] += amounts(i, kind);
  }

  CellMap map;
  map.values = values_of(
      sums, amounts, [](std::size_t) { return 1.0; }, 0);
  map.width = x.axis.cells;
  map.height = y.axis.cells;
  map.axes = {x.axis, y.axis};
  map.images = matter.matter.count;
  map.bad = amounts.bad();
  if (outside > 0) {
    map.notes.push_back(fmt::format(
        "keys map.x_range and map.y_range: {} of {} particles have values outside of them", outside,
        matter.matter.count));
  }
  return map;
}

namespace {

using boost::qvm::mag;

double farthest_particle(const CellMatter& matter, const Amounts& amounts) {
  double farthest = 0;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (amounts.is_good(i)) farthest = std::max(farthest, mag(nearest_offset(matter, i)));
  }
  return farthest;
}

// Up to half of the box, or to the last particle; down to a thousandth of it.
std::array<double, 2> radii_of(const CellMatter& matter, const Amounts& amounts) {
  if (matter.settings.shell) return *matter.settings.shell;
  constexpr double innermost = 1e-3;
  const auto& box = matter.geometry.box;
  const double last =
      box ? 0.5 * std::min({(*box)[0], (*box)[1], (*box)[2]}) : farthest_particle(matter, amounts);
  if (last > 0) return {innermost * last, last};
  throw UsageError(
      "key map.shell: found no particle away from the center, expected the key to be set");
}

std::vector<double> edges_of(const MapAxis& axis) {
  std::vector<double> edges;
  for (int i = 0; i <= axis.cells; ++i)
    edges.push_back(axis.edge(i));
  return edges;
}

double reach_of(const CellMatter& matter, std::size_t i) {
  return kernel_reach * matter.sigma * matter.matter.size_of(i);
}

ImagesAround images_in_reach(const CellMatter& matter, const Amounts& amounts, double last) {
  ImagesAround images;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (!amounts.is_good(i)) continue;
    const double reach = last + reach_of(matter, i);
    check_images(reach, matter.geometry.box, "key map.shell");
    for (const Vec3& place : images_within(nearest_offset(matter, i), reach, matter.geometry.box)) {
      if (mag(place) < reach) images.add(place, i);
    }
  }
  return images;
}

}  // namespace

CellMap draw_profile(const CellMatter& matter) {
  const Amounts amounts(matter.quantity, matter.matter.count, matter.weight_unit,
                        [&](std::size_t i) { return matter.matter.is_good(i); });
  const auto [first, last] = radii_of(matter, amounts);
  const MapAxis axis = {"radius", "", matter.settings.profile, first, last, true};
  const std::vector<double> edges = edges_of(axis);
  const ImagesAround images = images_in_reach(matter, amounts, last);
  CellSums sums(amounts.kinds(), static_cast<std::size_t>(axis.cells));
  const auto find = [&](std::size_t image, std::vector<CellShare>& shares) {
    const double sigma = matter.sigma * matter.matter.size_of(images.source[image]);
    add_shares_in_shells(edges, mag(images.offset[image]), sigma, shares);
  };
  const auto expected = [&axis](std::size_t) { return static_cast<double>(axis.cells); };
  add_up_shares(amounts, images.source, find, expected, matter.progress, sums);

  CellMap map;
  const auto volume = [&edges](std::size_t cell) {
    const double low = edges[cell], high = edges[cell + 1];
    return 4 * pi / 3 * (high - low) * (high * high + high * low + low * low);
  };
  map.values = values_of(sums, amounts, volume, 0);
  map.width = axis.cells;
  map.height = 1;
  map.axes = {axis};
  map.shell = {{first, last}};
  map.images = images.source.size();
  map.bad = amounts.bad();
  return map;
}

}  // namespace splotchcl
