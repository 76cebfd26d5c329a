#include "device/stages/clouds_in_lists.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstring>

#include "parallel/for_blocks.h"
#include "scene/projection.h"

namespace splotchcl {
namespace {

// A pixel's mean of narrower splats is not known from its center (clouds.cl).
constexpr double narrowest_sigma = 4;
// That of wider ones is their value there once they are widened, to 1.2e-7.
constexpr double wide_sigma = 16;
// Brighter clouds keep all digits of what is behind the camera.
constexpr double bright_amplitude = 4;
// Numbers of clouds are exact as floats.
constexpr std::size_t most_clouds = std::size_t{1} << 20;

constexpr std::uint32_t all_bits = ~0u;

std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

bool is_wide(const CloudAround& cloud) {
  return std::all_of(cloud.splats.begin(), cloud.splats.end(), [](const SplatAround& splat) {
    return splat.sigma_x >= narrowest_sigma && splat.sigma_y >= narrowest_sigma;
  });
}

shared::CloudEntry entry_of(const CloudAround& cloud) {
  shared::CloudEntry entry{};
  double deepest = 0, brightest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    entry.center[c] = static_cast<float>(cloud.center.a[c]);
    entry.emission[c] = static_cast<float>(cloud.emission[c]);
    entry.absorption[c] = static_cast<float>(cloud.absorption[c]);
    deepest = std::max(deepest, cloud.absorption[c]);
    brightest = std::max({brightest, cloud.emission[c], cloud.absorption[c]});
  }
  entry.distance2 = static_cast<float>(boost::qvm::mag_sqr(cloud.center));
  entry.ray = static_cast<float>(cloud.ray);
  entry.farthest2 = static_cast<float>(cloud.farthest2);
  const double column = cloud.ray + cloud.splat * static_cast<double>(cloud.splats.size());
  entry.is_bright = brightest > bright_amplitude;
  entry.deepest = static_cast<float>(deepest * column);
  return entry;
}

// The mean of a wide one over a pixel is the value at the center of one that is wider by as much as
// a pixel is, and fainter.
shared::CloudSplat splat_of(SplatAround splat, double part, const shared::Grid& grid,
                            Sampling sampling) {
  shared::CloudSplat entry{};
  if (sampling == Sampling::mean && splat.sigma_x >= wide_sigma && splat.sigma_y >= wide_sigma) {
    for (double* const sigma : {&splat.sigma_x, &splat.sigma_y}) {
      const double widened = std::hypot(*sigma, std::sqrt(1.0 / 6));
      part *= *sigma / widened;
      *sigma = widened;
    }
  } else if (sampling == Sampling::mean) {
    entry.mean_x = static_cast<float>(1 / (splat.sigma_x * splat.sigma_x));
    entry.mean_y = static_cast<float>(1 / (splat.sigma_y * splat.sigma_y));
  }
  entry.x = static_cast<float>(splat.x - grid.middle_x);
  entry.y = static_cast<float>(splat.y - grid.middle_y);
  entry.inverse_x = static_cast<float>(1 / splat.sigma_x);
  entry.inverse_y = static_cast<float>(1 / splat.sigma_y);
  entry.part = static_cast<float>(part);
  return entry;
}

// Directions of the tile's pixels: into the planes, and the cone that holds them. `directions` is
// room for them.
shared::DirectionCone look_through(const StageContext& context, int left, int top, float* planes,
                                   std::vector<Vec3>& directions) {
  using namespace boost::qvm;
  const shared::Grid& grid = context.layout.grids.front();
  const int width = static_cast<int>(context.variant.tile_width);
  const int height = static_cast<int>(context.variant.tile_height);
  directions.clear();
  Vec3 sum{};
  for (int y = top; y < top + height; ++y) {
    float* row = planes + static_cast<std::size_t>(y - grid.first_y) * grid.stride;
    for (int x = left; x < left + width; ++x) {
      directions.push_back(
          direction_at(x + 0.5, y + 0.5, context.frame.camera, context.frame.projection));
      sum += directions.back();
      for (std::size_t c = 0; c < 3; ++c)
        row[c * grid.plane_size + static_cast<std::size_t>(x - grid.first_x)] =
            static_cast<float>(directions.back().a[c]);
    }
  }
  const double length = mag(sum);
  const Vec3 middle = length > 0 ? Vec3(sum / length) : Vec3{{0, 0, 1}};
  double cosine = 1;
  for (const Vec3& direction : directions)
    cosine = std::min(cosine, dot(middle, direction));
  shared::DirectionCone cone{};
  for (std::size_t c = 0; c < 3; ++c)
    cone.direction[c] = static_cast<float>(middle.a[c]);
  cone.cosine = static_cast<float>(cosine);
  cone.sine = static_cast<float>(std::sqrt(std::max(1 - cosine * cosine, 0.0)));
  return cone;
}

void fill_directions(const StageContext& context, CloudTables& tables) {
  const shared::Grid& grid = context.layout.grids.front();
  BufferPool& pool = context.device.pool;
  tables.directions = pool.get<float>(std::uint64_t{3} * grid.plane_size, "directions");
  const MappedValues<float> planes = pool.map_to_write(tables.directions);
  const auto columns = static_cast<std::size_t>(grid.tiles_x);
  std::vector<shared::DirectionCone> cones(columns * static_cast<std::size_t>(grid.tiles_y));
  for_blocks(cones.size(), 8, [&](std::size_t first, std::size_t end) {
    std::vector<Vec3> directions;
    for (std::size_t tile = first; tile < end; ++tile) {
      const auto left = static_cast<int>(tile % columns * context.variant.tile_width);
      const auto top = static_cast<int>(tile / columns * context.variant.tile_height);
      cones[tile] =
          look_through(context, grid.first_x + left, grid.first_y + top, planes.data(), directions);
    }
  });
  tables.cones = pool.upload(cones, "cones of directions");
}

// A splat that touches all tiles of the picture's grid and adds no light by itself.
std::vector<std::uint32_t> splat_words(const Variant& variant, std::size_t cloud) {
  constexpr float everywhere = 1e18f;
  shared::Splat splat{};
  splat.sigma = -CLOUD_SIGMA * static_cast<float>(cloud + 1);
  splat.radius = everywhere;
  // Beyond what all splats have: widths along x, how ellipses are turned, colors of their own,
  // which weigh nothing here.
  std::vector<std::uint32_t> words(variant.splat_bytes() / sizeof(std::uint32_t), all_bits);
  std::memcpy(words.data(), &splat, sizeof(splat));
  std::size_t next = sizeof(splat) / sizeof(std::uint32_t);
  if (variant.ellipses) {
    words[next++] = bits_of(splat.sigma);
    words[next++] = bits_of(everywhere);
  }
  if (variant.face_of_cube) {
    constexpr std::size_t tilt_words = sizeof(shared::Tilt) / sizeof(std::uint32_t);
    std::fill_n(words.begin() + static_cast<std::ptrdiff_t>(next), tilt_words, 0u);
    next += tilt_words;
    words[next++] = bits_of(1);
  }
  if (variant.vector_colors) std::fill_n(words.begin() + static_cast<std::ptrdiff_t>(next), 3, 0u);
  return words;
}

template <class T>
void write(const StageContext& context, const std::vector<T>& values, std::size_t first_byte,
           const compute::buffer& memory) {
  DeviceContext& device = context.device;
  device.timer.add_copy(device.queue.enqueue_write_buffer(
      memory, first_byte, values.size() * sizeof(T), values.data()));
}

}  // namespace

bool CloudsInLists::can_hold(const StageContext& context, const std::vector<CloudAround>& clouds) {
  const KernelSettings& kernel = context.frame.kernel;
  const FramePlan& plan = context.plan;
  return !plan.is_extended() && !plan.certify && !kernel.cut && clouds.size() < most_clouds &&
         (kernel.sampling == Sampling::center ||
          std::all_of(clouds.begin(), clouds.end(), is_wide));
}

CloudsInLists::CloudsInLists(const StageContext& context, const std::vector<CloudAround>& clouds)
    : context_(&context) {
  std::vector<shared::CloudEntry> entries;
  std::vector<shared::CloudSplat> splats;
  for (const CloudAround& cloud : clouds) {
    keys_.push_back(cloud.key);
    shared::CloudEntry entry = entry_of(cloud);
    entry.first_splat = static_cast<std::uint32_t>(splats.size());
    for (const SplatAround& splat : cloud.splats) {
      splats.push_back(splat_of(splat, cloud.splat, context.layout.grids.front(),
                                context.frame.kernel.sampling));
    }
    entry.end_splat = static_cast<std::uint32_t>(splats.size());
    entries.push_back(entry);
  }
  tables_.entries = context.device.pool.upload(entries, "clouds around");
  tables_.splats = context.device.pool.upload(splats, "splats of clouds around");
  fill_directions(context, tables_);
}

void CloudsInLists::append(std::size_t begin, std::size_t end, KeyedSplats& keyed) const {
  if (begin == end) return;
  const Variant& variant = context_->variant;
  const std::size_t splat_bytes = variant.splat_bytes();
  std::vector<std::uint32_t> keys, order;
  for (std::size_t cloud = begin; cloud < end; ++cloud) {
    const std::size_t i = cloud - begin;
    const std::uint32_t slot = keyed.free_slots.empty()
                                   ? keyed.count + static_cast<std::uint32_t>(i)
                                   : keyed.free_slots[i];
    write(*context_, splat_words(variant, cloud), slot * splat_bytes, keyed.splats.memory());
    if (keyed.key_ends.size() > 0) {
      const std::vector<std::uint16_t> key_end = {static_cast<std::uint16_t>(keys_[cloud])};
      write(*context_, key_end, slot * sizeof(std::uint16_t), keyed.key_ends.memory());
    }
    keys.push_back(static_cast<std::uint32_t>(keys_[cloud] >> 16));
    order.push_back(slot);
  }
  const std::size_t first = keyed.count;
  write(*context_, keys, first * sizeof(std::uint32_t), keyed.keys.memory());
  write(*context_, order, first * sizeof(std::uint32_t), keyed.order.memory());
  keyed.count += static_cast<std::uint32_t>(end - begin);
}

std::vector<std::uint64_t> CloudLayers::places_among(const std::vector<std::uint64_t>& keys,
                                                     std::uint64_t first, std::size_t begin_cloud,
                                                     std::size_t end_cloud) const {
  std::vector<std::uint64_t> cloud_keys;
  for (std::size_t k = begin_cloud; k < end_cloud; ++k)
    cloud_keys.push_back(clouds_[k].key);
  // Of each of these clouds the splats between it and the one before, and those behind all.
  std::vector<std::uint64_t> between(cloud_keys.size() + 1);
  for (const std::uint64_t key : keys) {
    const auto behind = std::lower_bound(cloud_keys.begin(), cloud_keys.end(), key);
    ++between[static_cast<std::size_t>(behind - cloud_keys.begin())];
  }
  std::vector<std::uint64_t> places;
  for (std::size_t k = 0; k < cloud_keys.size(); ++k) {
    first += between[k];
    places.push_back(first);
  }
  return places;
}

void CloudLayers::skip_before(std::uint64_t first) {
  while (taken_ < splats_before_.size() && splats_before_[taken_] < first)
    ++taken_;
}

std::optional<CloudLayer> CloudLayers::take_before(std::uint64_t end) {
  if (taken_ == splats_before_.size() || splats_before_[taken_] >= end) return std::nullopt;
  CloudLayer layer = {taken_, taken_, splats_before_[taken_]};
  while (layer.end < splats_before_.size() && splats_before_[layer.end] == layer.splats_before)
    ++layer.end;
  taken_ = layer.end;
  return layer;
}

}  // namespace splotchcl
