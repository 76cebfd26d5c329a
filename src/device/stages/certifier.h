#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "certificate/certificate.h"
#include "device/frame/records.h"
#include "device/frame/shared.h"
#include "device/frame/stage_context.h"
#include "device/frame/variant.h"

namespace splotchcl {

// Where a tile's cells are, in which the stage `certify` collects: sets peaks, endings, listed and
// cells_per_tile. Throws DeviceError where tiles are neither squares nor twice as wide as high: the
// numbers of their pixels would not follow each other (certify.h).
void lay_out_cells(const Variant& variant, shared::CertifyParameters& parameters);

// What was collected, read back tile by tile: to be gathered while the device does other work.
struct CellsOfTiles {
  std::vector<float> values;  // none: nothing was collected
  shared::CertifyParameters parameters{};
  std::size_t tile_count = 0;
  int tile_width = 0, tile_height = 0;
  std::vector<shared::Grid> grids;
  GridPyramid pyramid;

  // Octaves without splats are left out.
  void gather(CollectedSplats& splats) const;
};

// Collects what a frame's splats add up to, from the lists that were drawn: the stage `certify`.
// Not for extended precision, whose bound holds for any splats.
class Certifier {
 public:
  explicit Certifier(const StageContext& context);

  // Adds what the lists have to `cells`: of all lists so far, tile by tile; none, where there were
  // no lists.
  void collect(const TileLists& lists, Buffer<float>& cells) const;
  // Makes those of no lists, where there are none.
  void begin(Buffer<float>& cells) const;
  // Waits for the device.
  CellsOfTiles read(const Buffer<float>& cells) const;
  // Memory for as much, of which nothing has been written to; none in extended precision.
  Buffer<float> room() const;
  std::uint32_t cells_per_tile() const { return parameters_.cells_per_tile; }

 private:
  void collect_in_groups(const TileLists& lists, const shared::CertifyParameters& parameters,
                         const Buffer<float>& cells) const;

  const StageContext& context_;
  shared::CertifyParameters parameters_{};
  Program program_;
};

}  // namespace splotchcl
