#include "device/stages/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"
#include "device/stages/project_parameters.h"
#include "device/stages/stage_programs.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "scene/plan/light_structure.h"
#include "scene/projection.h"
#include "splotchcl/error.h"
#include "surroundings/cloud_around.h"
#include "surroundings/columns_around.h"

namespace splotchcl {
namespace {

// An optical depth as planes carry it (opacity.cl).
double carried(double depth, bool keeps_transmittance) {
  constexpr double least = std::numeric_limits<float>::min();
  const double opacity = -std::expm1(-depth);
  if (!keeps_transmittance || opacity < 0.5) return opacity;
  return -std::max(std::exp(-depth), least);
}

// A row of optical depths. Most layers are thin, and take no function then: by five terms of the
// series, whose error is depth^5 / 720 of it, less than single precision rounds off.
void carry_depths(double* depths, std::size_t count, bool keeps_transmittance) {
  constexpr double thin = 0.03;
  const bool are_thin = *std::max_element(depths, depths + count) < thin;
  for (double* d = depths; d < depths + count; ++d) {
    *d = are_thin ? *d * (1 - *d * (1. / 2 - *d * (1. / 6 - *d * (1. / 24 - *d * (1. / 120)))))
                  : carried(*d, keeps_transmittance);
  }
}

// Of what is worked out for a pixel of a layer: in ordered frames light and optical depths, else
// the sum.
std::size_t channels_of_layer(const FramePlan& plan) {
  return plan.light == LightPlan::ordered ? 6 : 3;
}

// The layer as the planes of the picture's grid have it (kernels/composite/behind.cl), without
// padding: of the frame's crop; in extended frames two planes for each channel, as pairs of floats.
Buffer<float> layer_planes(const StageContext& context, const SmoothPicture& layer) {
  const auto width = static_cast<std::size_t>(context.frame.crop.width);
  const auto height = static_cast<std::size_t>(context.frame.crop.height);
  const std::size_t channels = channels_of_layer(context.plan);
  const std::size_t planes = context.plan.is_extended() ? 2 : 1, pixels = width * height;
  BufferPool& pool = context.device.pool;
  Buffer<float> buffer = pool.get<float>(planes * channels * pixels, "clouds around");
  const MappedValues<float> mapped = pool.map_to_write(buffer);
  constexpr std::size_t rows_at_once = 8;
  for_blocks(height, rows_at_once, [&](std::size_t first, std::size_t end) {
    std::vector<double> row;
    for (std::size_t y = first; y < end; ++y) {
      layer.row(static_cast<int>(y), row);
      // Interpolation may leave less than nothing, by as little as it errs.
      for (double& number : row)
        number = std::max(number, 0.0);
      for (std::size_t c = 0; c < channels; ++c) {
        double* const numbers = row.data() + c * width;
        float* const to = mapped.data() + planes * c * pixels + y * width;
        if (c >= 3) carry_depths(numbers, width, context.plan.layers.keeps_transmittance);
        for (std::size_t x = 0; x < width; ++x)
          to[x] = static_cast<float>(numbers[x]);
        for (std::size_t x = 0; planes == 2 && x < width; ++x)
          to[x + pixels] = pair_of(numbers[x]).low;
      }
    }
  });
  return buffer;
}

// Less of a column of 1 shows nowhere, however many there are.
constexpr double negligible = 1e-14;

// Of what clouds around the camera may err by, what all of them together lose by ending.
constexpr double share_of_ends = 1e-3;

[[noreturn]] void refuse(const DeviceContext& device, std::uint64_t counted, std::uint64_t listed) {
  throw DeviceError("device " + device.device.name() + ": counted " + std::to_string(counted) +
                    " clouds around the camera and listed " + std::to_string(listed) +
                    ": draw with another device (--device)");
}

// phi(y) = (1 - exp(-y)) / y.
double phi(double y) {
  return y < 1e-4 ? 1 - y / 2 + y * y / 6 : -std::expm1(-y) / y;
}

double brightest_of(const CloudAround& cloud) {
  double brightest = 0;
  for (std::size_t c = 0; c < 3; ++c)
    brightest = std::max({brightest, cloud.emission[c], cloud.absorption[c]});
  return brightest;
}

// What the error of a channel does to light, over max(1, light). Light behind an error of the
// optical depth has faded by that depth: it errs by as large a part of itself.
double light_error(LightPlan light, double brightest, const double* exact, const double* foretold,
                   std::size_t channel) {
  const double error = std::abs(exact[channel] - foretold[channel]);
  if (light == LightPlan::emission) return error / std::max(1.0, exact[channel]);
  if (light == LightPlan::proportional) {
    return brightest * error / std::max(1.0, -brightest * std::expm1(-exact[channel]));
  }
  return error / std::max(1.0, exact[channel]) +
         std::abs(exact[channel + 3] - foretold[channel + 3]);
}

// A cloud's column behind the light, three channels, and the optical depths of what is in front.
void add_behind(const CloudAround& cloud, double column, double* channels) {
  if (column == 0) return;
  for (std::size_t c = 0; c < 3; ++c) {
    const double depth = column * cloud.absorption[c];
    channels[c] += std::exp(-channels[c + 3]) * cloud.emission[c] * column * phi(depth);
    channels[c + 3] += depth;
  }
}

void add_sum(const CloudAround& cloud, double column, LightPlan light, double* channels) {
  const std::array<double, 3>& summed =
      light == LightPlan::emission ? cloud.emission : cloud.absorption;
  for (std::size_t c = 0; c < 3; ++c)
    channels[c] += column * summed[c];
}

}  // namespace

void Surroundings::get_programs() const {
  ProgramCache& programs = context_.device.programs;
  const Program list = programs.get(list_around_program(context_.variant));
  const Program behind = programs.get(behind_program(context_.variant));
  programs.compile_all();
  // What an earlier run has compiled is read with its first kernel.
  list.create_kernel("list_around");
  behind.create_kernel("put_behind");
}

std::vector<Surroundings::Found> Surroundings::list(const ChunkBlocks& blocks,
                                                    const ParticleBuffers& particles,
                                                    std::uint64_t most) const {
  DeviceContext& device = context_.device;
  const ParticleChunk& chunk = blocks.chunk;
  const shared::ProjectParameters<float> p = make_project_parameters(context_, chunk, particles);
  const auto capacity = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, chunk.count()));
  const auto listed = device.pool.get<std::uint32_t>(3 * (std::uint64_t{capacity} + 1), "around");
  clear_memory(device, "surroundings", listed.memory(), 0, sizeof(std::uint32_t));
  const Program program = device.programs.get(list_around_program(context_.variant));
  Launch launch(device, "surroundings", program.create_kernel("list_around"));
  const Buffer<std::uint32_t> looked_through = device.pool.upload(blocks.blocks, "blocks around");
  pass_columns(pass_parameters(launch, context_, p), particles)
      .arg(looked_through)
      .arg(listed)
      .value(static_cast<cl_uint>(capacity));
  launch.run_items(blocks.blocks.size());
  const std::uint32_t count = device.pool.download(listed, 1).front();
  if (count > capacity) refuse(device, most, count);
  const std::vector<std::uint32_t> words =
      device.pool.download(listed, 3 * (std::size_t{count} + 1));
  std::vector<Found> found;
  for (std::size_t k = 3; k < words.size(); k += 3) {
    found.push_back({particles.first + words[k], words[k + 1] | std::uint64_t{words[k + 2]} << 32});
  }
  // Work-items list them in any order.
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.particle < b.particle; });
  return found;
}

void Surroundings::append(std::uint32_t c, const std::vector<Found>& found,
                          std::vector<CloudAround>& clouds) const {
  const Frame& frame = context_.frame;
  Places places;
  std::vector<std::uint64_t> keys;
  for (const Found& one : found) {
    if (one.key >= end_of_keys) continue;  // beyond the limits that the scene sets
    places.push_back(one.particle);
    keys.push_back(one.key);
  }
  DrawnComponent component = frame.components[c];
  component.particles = picked_particles(component.particles, places);
  const double widest = widest_angle(frame);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    CloudAround cloud = cloud_around(component, frame, k);
    cloud.key = keys[k];
    if (brightest_of(cloud) * largest_column_around(cloud, frame, widest) > negligible)
      clouds.push_back(std::move(cloud));
  }
}

// The most light that an optical depth takes away, 1 at least.
double Surroundings::brightest() const {
  const std::array<double, 3>& source = context_.plan.source;
  return std::max(
      {1.0, *std::max_element(source.begin(), source.end()), brightest_background(context_.frame)});
}

void Surroundings::end_where_nothing_shows(std::vector<CloudAround>& clouds, double share) const {
  const double lost = share * share_of_promise * context_.plan.shares.promise /
                      (brightest() * static_cast<double>(clouds.size()));
  const double widest = widest_angle(context_.frame);
  clouds.erase(std::remove_if(clouds.begin(), clouds.end(),
                              [&](const CloudAround& cloud) {
                                return brightest_of(cloud) *
                                           largest_column_around(cloud, context_.frame, widest) <
                                       lost;
                              }),
               clouds.end());
  for (CloudAround& cloud : clouds) {
    const double ends = std::log(brightest_of(cloud) / lost);
    cloud.farthest2 = std::clamp(ends, 0.0, cloud.farthest2);
  }
}

std::vector<CloudAround> Surroundings::list(
    const std::vector<ChunkBlocks>& chunks,
    const std::function<ParticleBuffers(const ParticleChunk&)>& get, std::uint64_t counted) const {
  std::vector<CloudAround> clouds;
  std::uint64_t listed = 0;
  for (const ChunkBlocks& blocks : chunks) {
    if (listed == counted) break;
    const std::vector<Found> found = list(blocks, get(blocks.chunk), counted - listed);
    listed += found.size();
    append(blocks.chunk.component, found, clouds);
  }
  if (listed != counted) refuse(context_.device, counted, listed);
  return clouds;
}

std::vector<CloudAround> Surroundings::in_order(std::vector<CloudAround> clouds) const {
  end_where_nothing_shows(clouds, share_of_ends);
  std::stable_sort(clouds.begin(), clouds.end(),
                   [](const CloudAround& a, const CloudAround& b) { return a.key < b.key; });
  return clouds;
}

// The layer's light and depth in each pixel of the crop: in ordered scenes S, then tau, else the
// sum.
SmoothPicture Surroundings::picture_of(const std::vector<CloudAround>& clouds,
                                       const CloudLayer& layer, double allowed,
                                       double brightest) const {
  const Frame& frame = context_.frame;
  const FramePlan& plan = context_.plan;
  const LightPlan light = plan.light;
  const bool is_ordered = light == LightPlan::ordered;
  constexpr double exact = 2e-11, part_of_promise = 1e-4;
  const double wide_sigma =
      sigma_of_means_by_values(plan.is_extended() ? exact : part_of_promise * plan.shares.promise);
  const CloudsInBlocks in_blocks(clouds, layer.first, layer.end, frame);
  const auto add_all = [&](const PixelsOfRow& pixels, const std::vector<std::uint32_t>& shown,
                           double* channels) {
    PixelsOfRow::OfPixels<double> columns;
    for (const std::uint32_t k : shown) {
      if (!columns_around(clouds[k], pixels, frame.kernel, wide_sigma, columns)) continue;
      for (std::size_t i = 0; i < pixels.count; ++i) {
        if (is_ordered) {
          add_behind(clouds[k], columns[i], channels + 6 * i);
        } else {
          add_sum(clouds[k], columns[i], light, channels + 3 * i);
        }
      }
    }
  };
  // Pixels of which the same clouds are seen at a time.
  const auto pixels_of_row = [&](const std::vector<int>& x, int y, int spacing, double* channels) {
    for (std::size_t first = 0, end = 0; first < x.size(); first = end) {
      const std::vector<std::uint32_t>& shown = in_blocks.at(x[first], y, spacing);
      while (end < x.size() && end - first < PixelsOfRow::most &&
             &in_blocks.at(x[end], y, spacing) == &shown)
        ++end;
      add_all(PixelsOfRow(x.data() + first, end - first, y, frame), shown,
              channels + first * channels_of_layer(plan));
    }
  };
  SmoothPictureSettings settings;
  settings.width = frame.width;
  settings.height = frame.height;
  settings.crop = frame.crop;
  settings.crop_alone = plan.is_trial();
  settings.channels = static_cast<int>(channels_of_layer(plan));
  // What a certified frame shows is worked out in every pixel, not foretold.
  settings.narrowest = plan.certify ? 0 : narrowest_detail(clouds, layer.first, layer.end, frame);
  settings.allowed = allowed;
  settings.error_of = [light, brightest](const double* exact, const double* foretold) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, light_error(light, brightest, exact, foretold, c));
    return largest;
  };
  return SmoothPicture(settings, pixels_of_row);
}

// The layer in stretches of clouds that are worked out alike, one behind the other.
void Surroundings::draw(const std::vector<CloudAround>& clouds, const CloudLayer& layer,
                        const Planes& planes) const {
  // Certified frames are worked out in every pixel.
  const std::vector<std::size_t> ends =
      context_.plan.certify ? std::vector{layer.end}
                            : ends_of_stretches(clouds, layer.first, layer.end, context_.frame);
  // There are no more layers than clouds, and of sums one.
  const std::size_t layers = context_.plan.needs_sort() ? clouds.size() : 1;
  CloudLayer stretch = layer;
  for (const std::size_t end : ends) {
    stretch.end = end;
    put_behind(clouds, stretch, std::max(layers, ends.size()), planes);
    stretch.first = end;
  }
}

void Surroundings::put_behind(const std::vector<CloudAround>& clouds, const CloudLayer& layer,
                              std::size_t parts, const Planes& planes) const {
  const Rectangle& crop = context_.frame.crop;
  shared::BehindParameters parameters{};
  parameters.width = crop.width;
  parameters.height = crop.height;
  parameters.crop_x = crop.x;
  parameters.crop_y = crop.y;
  DeviceContext& device = context_.device;
  const double allowed =
      0.25 * share_of_promise * context_.plan.shares.promise / static_cast<double>(parts);
  const double of_depth = brightest();
  const SmoothPicture picture = picture_of(clouds, layer, allowed, of_depth);
  const Buffer<float> behind = layer_planes(context_, picture);
  const auto items =
      static_cast<std::size_t>(ceil_divide(crop.width, context_.variant.pixels_behind()));
  Launch(device, "surroundings",
         device.programs.get(behind_program(context_.variant)).create_kernel("put_behind"))
      .value(parameters)
      .arg(context_.grids)
      .arg(planes.light)
      .arg(behind)
      .run_grid(items, static_cast<std::size_t>(crop.height), 1);
}

}  // namespace splotchcl
