#include "device/stages/layer_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "device/frame/float_pair.h"
#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

// That a thread works out.
constexpr std::size_t rows_at_once = 8;

// An optical depth as planes carry it (opacity.cl).
float carried(double depth, bool keeps_transmittance) {
  const double opacity = -std::expm1(-depth);
  if (!keeps_transmittance || opacity < 0.5) return static_cast<float>(opacity);
  return -std::max(static_cast<float>(std::exp(-depth)), std::numeric_limits<float>::min());
}

// A row of light. Interpolation may leave less than nothing, by as little as it errs.
template <class Number>
void put_light(const Number* light, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i)
    to[i] = static_cast<float>(std::max(light[i], Number(0)));
}

// A row of optical depths as planes carry them. Most layers are thin, and take no function then: by
// five terms of the series, whose error is depth^5 / 720 of it, less than single precision rounds
// off.
template <class Number>
void put_depths(const Number* depths, std::size_t count, bool keeps_transmittance, float* to) {
  constexpr double thin = 0.03;
  const bool are_thin = static_cast<double>(*std::max_element(depths, depths + count)) < thin;
  for (std::size_t i = 0; i < count; ++i) {
    const Number d = std::max(depths[i], Number(0));
    if (!are_thin) {
      to[i] = carried(static_cast<double>(d), keeps_transmittance);
      continue;
    }
    constexpr auto half = static_cast<Number>(1. / 2), sixth = static_cast<Number>(1. / 6),
                   fourth = static_cast<Number>(1. / 24), fifth = static_cast<Number>(1. / 120);
    to[i] = static_cast<float>(d * (1 - d * (half - d * (sixth - d * (fourth - d * fifth)))));
  }
}

// Numbers as pairs of floats.
void split(const double* values, std::size_t count, float* high, float* low) {
  for (std::size_t i = 0; i < count; ++i) {
    const shared::FloatPair pair = pair_of(values[i]);
    high[i] = pair.high;
    low[i] = pair.low;
  }
}

// The planes in single precision, a channel each.
template <class Number>
void put_rows(const StageContext& context, const SmoothPicture& layer, float* planes) {
  const auto width = static_cast<std::size_t>(context.frame.crop.width);
  const auto height = static_cast<std::size_t>(context.frame.crop.height);
  const bool keeps_transmittance = context.plan.layers.keeps_transmittance;
  for_blocks(height, rows_at_once, [&](std::size_t first, std::size_t end) {
    std::vector<Number> row;
    for (std::size_t y = first; y < end; ++y) {
      layer.row(static_cast<int>(y), row);
      for (std::size_t c = 0; c < channels_of_layer(context.plan); ++c) {
        const Number* const values = row.data() + c * width;
        float* const to = planes + (c * height + y) * width;
        if (c >= 3)
          put_depths(values, width, keeps_transmittance, to);
        else
          put_light(values, width, to);
      }
    }
  });
}

// Two planes for each channel.
void put_rows_of_pairs(const StageContext& context, const SmoothPicture& layer, float* planes) {
  const auto width = static_cast<std::size_t>(context.frame.crop.width);
  const auto height = static_cast<std::size_t>(context.frame.crop.height);
  const std::size_t pixels = width * height;
  for_blocks(height, rows_at_once, [&](std::size_t first, std::size_t end) {
    std::vector<double> row;
    for (std::size_t y = first; y < end; ++y) {
      layer.row(static_cast<int>(y), row);
      for (std::size_t c = 0; c < channels_of_layer(context.plan); ++c) {
        float* const to = planes + 2 * c * pixels + y * width;
        split(row.data() + c * width, width, to, to + pixels);
      }
    }
  });
}

}  // namespace

std::size_t channels_of_layer(const FramePlan& plan) {
  return plan.light == LightPlan::ordered ? 6 : 3;
}

Buffer<float> layer_planes(const StageContext& context, const SmoothPicture& layer,
                           bool may_round) {
  const auto pixels = static_cast<std::size_t>(context.frame.crop.width) *
                      static_cast<std::size_t>(context.frame.crop.height);
  const bool is_extended = context.plan.is_extended();
  BufferPool& pool = context.device.pool;
  Buffer<float> planes = pool.get<float>(
      (is_extended ? 2 : 1) * channels_of_layer(context.plan) * pixels, "clouds around");
  const MappedValues<float> mapped = pool.map_to_write(planes);
  if (is_extended)
    put_rows_of_pairs(context, layer, mapped.data());
  else if (may_round)
    put_rows<float>(context, layer, mapped.data());
  else
    put_rows<double>(context, layer, mapped.data());
  return planes;
}

}  // namespace splotchcl
