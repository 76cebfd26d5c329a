#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Even light of splats on a lattice, seen along its axis, loses a row of them beyond each side
// of their squares: up to this times exp(-k^2) of itself (docs/dev/accuracy.md).
constexpr double lattice_rows = 2;

// By how much of its peak the widened center value of a splat errs at most, from sigma 2 on.
double center_value_error(double sigma_pixels);

// By how much of its peak a mean by erf errs, along both axes together, for each sigma.
double error_of_means(Precision precision);

// By which part of itself a shape by exp errs, along both axes together.
double error_of_shapes(Precision precision);

// The width up to which splats that count as bright ones, of this light, are taken as means that
// keep their digits (kernels/project/limits.cl); and the light from which on that is so wide.
double widest_bright_mean(const SplatLimits& limits, double light);
double light_of_bright_means(const SplatLimits& limits, double sigma_pixels);

// By how much of its peak such a mean errs at most, along both axes together; and by which part of
// itself, where splats of so much light have not faded below 1.
double bright_mean_error(double narrowest_sigma, double widest_sigma);
double part_of_bright_mean(double narrowest_sigma, double widest_sigma, double light);

// What a relative error of every splat does to the picture (error_budget.h), by what is wrong.
struct Responses {
  double of_ends = 1, of_means = 1;  // which the check after drawing knows
  double of_bright_means = 1;
};

// Whether pixels take means of splats. On the faces of a cube they take the values at their centers
// of splats that are as wide as pixels make them (docs/projections.md).
bool takes_pixel_means(const Frame& frame);

// The light of the brightest splat that is drawn no farther than the faintest ones are.
double edge_peak(const SplatLimits& limits);

// How far splats of an octave of widths are drawn at least, in sigma, squared.
double least_extent2(const FramePlan& plan, int octave);

SplatLimits choose_splat_limits(const Frame& frame, const ToleranceShares& shares, LightPlan light,
                                const Responses& response);

// `brightest_behind`: the most that can shine through a layer. `response`: of every layer alike.
// `longest_block`: as many layers as are put together where their roundings do not show.
LayerLimits choose_layer_limits(const ToleranceShares& shares, LightPlan light,
                                double brightest_behind, double response,
                                std::uint32_t longest_block);

// For the precision and the tolerance that the plan has by now. `response`: what a relative error
// of every splat does to the picture (error_budget.h).
PlaceLimits choose_place_limits(const Frame& frame, const FramePlan& plan, double response);

}  // namespace splotchcl
