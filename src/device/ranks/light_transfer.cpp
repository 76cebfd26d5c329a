#include "device/ranks/light_transfer.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace splotchcl {
namespace {

// What is told before light comes.
struct LightHeader {
  std::uint32_t used_grids = 0;
  std::uint32_t cells = 0;
};

// The host holds so many floats at a time.
constexpr std::uint64_t most_at_once = 16u << 20;

}  // namespace

template <class T>
void LightTransfer::send_values(const Buffer<T>& buffer, std::uint64_t first, std::uint64_t count,
                                int to) const {
  std::vector<T> values;
  for (std::uint64_t done = 0; done < count; done += values.size()) {
    values.resize(static_cast<std::size_t>(std::min(most_at_once, count - done)));
    context_.device.pool.read(buffer, first + done, values.data(), values.size());
    ranks_.all.send(values.data(), values.size() * sizeof(T), to);
  }
  ranks_.work.sent_bytes += count * sizeof(T);
}

template <class T>
void LightTransfer::receive_values(const Buffer<T>& buffer, std::uint64_t first,
                                   std::uint64_t count, int from) const {
  std::vector<T> values;
  for (std::uint64_t done = 0; done < count; done += values.size()) {
    values.resize(static_cast<std::size_t>(std::min(most_at_once, count - done)));
    ranks_.all.receive(values.data(), values.size() * sizeof(T), from);
    context_.device.pool.write(buffer, first + done, values.data(), values.size());
  }
}

void LightTransfer::send(const SplatLight& light, int to) const {
  const LightHeader header = {light.planes.used_grids,
                              static_cast<std::uint32_t>(light.cells.size())};
  ranks_.all.send(&header, sizeof(header), to);
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    if ((header.used_grids >> g & 1) == 0) continue;
    const shared::Grid& grid = context_.layout.grids[g];
    send_values(light.planes.light, floats_before(grid),
                std::uint64_t{context_.variant.planes()} * grid.plane_size, to);
  }
  send_values(light.cells, 0, header.cells, to);
}

SplatLight LightTransfer::receive(int from) const {
  LightHeader header;
  ranks_.all.receive(&header, sizeof(header), from);
  SplatLight light;
  light.planes = compositor_.start();
  light.planes.used_grids = header.used_grids;
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    if ((header.used_grids >> g & 1) == 0) continue;
    const shared::Grid& grid = context_.layout.grids[g];
    receive_values(light.planes.light, floats_before(grid),
                   std::uint64_t{context_.variant.planes()} * grid.plane_size, from);
  }
  if (header.cells > 0) light.cells = context_.device.pool.get<float>(header.cells, "peak cells");
  receive_values(light.cells, 0, header.cells, from);
  return light;
}

template <class Pass>
void LightTransfer::in_planes(const TileBand& tiles, const Pass& pass) const {
  const shared::Grid& grid = context_.layout.grids.front();
  const auto across = static_cast<std::uint32_t>(grid.tiles_x);
  const std::uint64_t row = std::uint64_t{grid.stride} * context_.variant.tile_height;
  for (std::uint32_t plane = 0; plane < context_.variant.planes(); ++plane) {
    pass(floats_before(grid) + std::uint64_t{plane} * grid.plane_size + tiles.first / across * row,
         (tiles.end - tiles.first) / across * row);
  }
}

void LightTransfer::send(const Rows& rows, const TileBand& tiles, int to) const {
  in_planes(tiles, [&](std::uint64_t first, std::uint64_t count) {
    send_values(rows.planes.light, first, count, to);
  });
  send_values(rows.cells, std::uint64_t{tiles.first} * rows.cells_per_tile,
              std::uint64_t{tiles.end - tiles.first} * rows.cells_per_tile, to);
}

void LightTransfer::receive(const Rows& rows, const TileBand& tiles, int from) const {
  in_planes(tiles, [&](std::uint64_t first, std::uint64_t count) {
    receive_values(rows.planes.light, first, count, from);
  });
  receive_values(rows.cells, std::uint64_t{tiles.first} * rows.cells_per_tile,
                 std::uint64_t{tiles.end - tiles.first} * rows.cells_per_tile, from);
}

void LightTransfer::send(const SlabLight& slab, int to) const {
  send_values(slab.before, 0, slab.before.size(), to);
  send_values(slab.errors, 0, slab.errors.size(), to);
}

void LightTransfer::receive(const SlabLight& slab, int from) const {
  receive_values(slab.before, 0, slab.before.size(), from);
  receive_values(slab.errors, 0, slab.errors.size(), from);
}

}  // namespace splotchcl
