#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cells/shares_on_the_sky.h"
#include "load/component_fields.h"
#include "map/geometry.h"
#include "map/quantity.h"
#include "splotchcl/map.h"

// Maps whose cells are no pixels of a plane: sums over kernels in double precision, cell by cell.
namespace splotchcl {

// What such a map is made of.
struct CellMatter {
  const MapSettings& settings;
  const MapMatter& matter;
  const MapGeometry& geometry;
  const MapQuantity& quantity;
  double sigma = 1;         // of the kernel for h = 1
  double weight_unit = 1;   // in the snapshot's units
  double tolerance = 1e-3;  // of sums in cells that are not exact
  std::function<void(double)> progress;
};

// Lengths and values in the snapshot's units, floors in those of the weights per size of a cell.
struct CellMap {
  int width = 0, height = 0;
  std::vector<double> values;  // row 0 at the top, plane by plane
  std::vector<MapAxis> axes;   // with the unit "": a length
  std::optional<HealpixPixels> healpix;
  std::optional<SkyPlace> sky;
  std::optional<std::array<double, 2>> shell;
  double floor = 0, value_floor = 0;
  std::size_t images = 0, bad = 0;
  std::vector<std::string> notes;
};

// Of the pixels of a sphere, or of a picture of the sky `width` x `height` pixels large.
CellMap draw_sky(const CellMatter& matter, int width, int height);
CellMap draw_voxels(const CellMatter& matter);
CellMap draw_profile(const CellMatter& matter);
// `type` is one of the particles'.
CellMap draw_histogram(const CellMatter& matter, const ComponentFields& fields, int type);

// Particles with their periodic images around the map's center.
struct ImagesAround {
  std::vector<Vec3> offset;
  std::vector<std::uint32_t> source;

  void add(const Vec3& from_center, std::size_t particle) {
    offset.push_back(from_center);
    source.push_back(static_cast<std::uint32_t>(particle));
  }
};

// Of a particle from the map's center, in a periodic box its nearest image.
Vec3 nearest_offset(const CellMatter& matter, std::size_t i);

// Throws UsageError, which `what` begins, where so many cells are more than memory has.
void check_cells(double cells, std::size_t kinds, const std::string& what);

// What is added up in cells, of each particle: its weight, and that times its value and the value's
// square, as far as the quantity needs them.
class Amounts {
 public:
  // `unit` is what weights are multiplied by.
  Amounts(const MapQuantity& quantity, std::size_t count, double unit,
          const std::function<bool(std::size_t)>& is_good);

  std::size_t kinds() const { return kinds_; }
  // 0 for a bad particle.
  double operator()(std::size_t i, std::size_t kind) const;
  // Of absolute amounts.
  double total(std::size_t kind) const { return totals_[kind]; }
  bool is_good(std::size_t i) const { return is_good_[i]; }
  std::size_t bad() const { return bad_; }
  MapQuantity::Kind kind() const { return quantity_.kind; }
  // The mean of all, from which a dispersion's deviations are taken; else 0.
  double middle() const { return middle_; }

 private:
  double weight_of(std::size_t i) const;
  double value_of(std::size_t i) const;

  const MapQuantity& quantity_;
  double unit_ = 1, middle_ = 0;
  std::size_t kinds_ = 1, bad_ = 0;
  std::vector<bool> is_good_;
  std::vector<double> totals_;
};

// Sums of amounts, cell by cell.
struct CellSums {
  CellSums(std::size_t kinds, std::size_t cells);

  std::vector<std::vector<double>> kinds;
};

// Adds up what `find` tells of each image, of the particle `source` says, in about `expected`
// cells, on all cores. Additions are in the order of images, so that sums do not depend on the
// cores.
using FindShares = std::function<void(std::size_t, std::vector<CellShare>&)>;
using ExpectedShares = std::function<double(std::size_t)>;
void add_up_shares(const Amounts& amounts, const std::vector<std::uint32_t>& source,
                   const FindShares& find, const ExpectedShares& expected,
                   const std::function<void(double)>& progress, CellSums& sums);

// What a map shows in each cell of this size: sums per size, or means where the weights per size
// reach the floor, and not a number elsewhere.
std::vector<double> values_of(const CellSums& sums, const Amounts& amounts,
                              const std::function<double(std::size_t)>& size, double floor);

}  // namespace splotchcl
