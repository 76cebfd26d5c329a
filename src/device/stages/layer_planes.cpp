#include "device/stages/layer_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

// That a thread works out.
constexpr std::size_t rows_at_once = 8;

// An optical depth as planes carry it (opacity.cl).
double carried(double depth, bool keeps_transmittance) {
  constexpr double least = std::numeric_limits<float>::min();
  const double opacity = -std::expm1(-depth);
  if (!keeps_transmittance || opacity < 0.5) return opacity;
  return -std::max(std::exp(-depth), least);
}

// A row of optical depths. Most layers are thin, and take no function then: by five terms of the
// series, whose error is depth^5 / 720 of it, less than single precision rounds off.
template <class Number>
void carry_depths(Number* depths, std::size_t count, bool keeps_transmittance) {
  constexpr double thin = 0.03;
  const bool are_thin = static_cast<double>(*std::max_element(depths, depths + count)) < thin;
  for (std::size_t i = 0; i < count; ++i) {
    const Number d = depths[i];
    if (!are_thin) {
      depths[i] = static_cast<Number>(carried(static_cast<double>(d), keeps_transmittance));
      continue;
    }
    constexpr auto half = static_cast<Number>(1. / 2), sixth = static_cast<Number>(1. / 6),
                   fourth = static_cast<Number>(1. / 24), fifth = static_cast<Number>(1. / 120);
    depths[i] = d * (1 - d * (half - d * (sixth - d * (fourth - d * fifth))));
  }
}

// Numbers as floats or, with `low`, as sums of two.
template <class Number>
void store(const Number* numbers, std::size_t count, float* high, float* low) {
  for (std::size_t i = 0; i < count; ++i) {
    high[i] = static_cast<float>(numbers[i]);
    if (low != nullptr) low[i] = static_cast<float>(numbers[i] - static_cast<Number>(high[i]));
  }
}

template <class Number>
void put_rows(const StageContext& context, const SmoothPicture& layer, float* planes) {
  const auto width = static_cast<std::size_t>(context.frame.crop.width);
  const auto height = static_cast<std::size_t>(context.frame.crop.height);
  const std::size_t pixels = width * height, planes_of_number = context.plan.is_extended() ? 2 : 1;
  const bool keeps_transmittance = context.plan.layers.keeps_transmittance;
  for_blocks(height, rows_at_once, [&](std::size_t first, std::size_t end) {
    std::vector<Number> row;
    for (std::size_t y = first; y < end; ++y) {
      layer.row(static_cast<int>(y), row);
      // Interpolation may leave less than nothing, by as little as it errs.
      for (Number& number : row)
        number = std::max(number, Number(0));
      for (std::size_t c = 0; c < channels_of_layer(context.plan); ++c) {
        Number* const numbers = row.data() + c * width;
        float* const to = planes + planes_of_number * c * pixels + y * width;
        if (c >= 3) carry_depths(numbers, width, keeps_transmittance);
        store(numbers, width, to, planes_of_number == 2 ? to + pixels : nullptr);
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
  BufferPool& pool = context.device.pool;
  Buffer<float> planes = pool.get<float>(
      (context.plan.is_extended() ? 2 : 1) * channels_of_layer(context.plan) * pixels,
      "clouds around");
  const MappedValues<float> mapped = pool.map_to_write(planes);
  if (may_round && !context.plan.is_extended())
    put_rows<float>(context, layer, mapped.data());
  else
    put_rows<double>(context, layer, mapped.data());
  return planes;
}

}  // namespace splotchcl
