#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace splotchcl
