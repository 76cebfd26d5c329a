#pragma once

#include <optional>
#include <string>

// How particles become light: the model that the device and the reference renderer draw, by the
// choices that a scene has in it. What an absorbing and emitting cloud does to the light behind it
// is equation (3) of Dolag, Reinecke, Gheller & Imboden, New J. Phys. 10, 125006 (2008), the paper
// below: I' = (I - E/A) exp(-A X) + E/A, with X the column of matter crossed, in units of the
// component's reference column, and E and A its emission and absorption in each channel.
namespace splotchcl {

// How a field's values are scaled before they are placed on the palette: linear, log10 of values
// > 0 (others take the palette's first color), or asinh.
enum class Scaling { linear, log, asinh };

// What a particle's column w is made of before color, in the snapshot's units: the column of
// matter along the line through its center, with the density profile
//   rho(r) = rho_0 exp(-r^2 / sigma^2),  so that  w = rho_0 sigma sqrt(pi),
// and rho_0 from the mass m = rho_0 pi^(3/2) sigma^3 or from a field. Note that sigma is sqrt(2)
// standard deviations.
//   mass      w = m / (pi sigma^2)              a column density
//   density   w = rho sigma sqrt(pi)            the paper's rho_0 as a field
//   constant  w = 1 / h                         as in the original program
enum class WeightModel { mass, density, constant };

enum class Sampling {
  mean,    // a pixel's value is the mean over its area: every particle keeps its light
  center,  // the value at the pixel's center
};

// How much a component absorbs, as structure rather than as numbers, since the plan
// is made from it. e is brightness * I * palette_E, with I the intensity field from 0 to 1.
//   as_emission      A = e, E = e                      (the default: E = A)
//   none             A = 0, E = e
//   factor           A = factor * I * palette_A, E = e
//   gray             A = e, E = e * e / (e + factor)   per channel, as in the original
struct Absorption {
  enum class Kind { as_emission, none, factor, gray };
  Kind kind = Kind::as_emission;
  double factor = 0;  // > 0 for factor, >= 0 for gray
};

// The width of the Gaussian: sigma = width * h, with h the smoothing length as Gadget has it,
// the radius beyond which the cubic spline kernel is 0. The default width, 1 / sqrt(20/3), gives
// the uncut Gaussian the second moment of that kernel.
struct KernelSettings {
  double width = 0.3872983346207417;  // > 0
  std::optional<double> cut;          // the Gaussian ends at cut * sigma, > 0; unset: never
  Sampling sampling = Sampling::mean;
  // h in pixels becomes h' = sqrt(h^2 + min_radius^2) and the weight is multiplied by
  // h / h', so small clouds gain light, as in the original. >= 0; 0: off.
  double min_radius_pixels = 0;
  // What a pixel sees beside its own square: the cloud is spread by a Gaussian of this standard
  // deviation, sigma'^2 = sigma^2 + 2 footprint^2, and keeps its light. >= 0; 0: the square alone.
  // Not together with min_radius_pixels. In panoramas it is a part of the sphere as wide as the
  // equator's pixels.
  double footprint_pixels = 0;
};

// Which particle lies in front. Nearest first; equal keys stay in component and file
// order, the earlier one in front.
struct SortOrder {
  enum class By { depth, field };
  By by = By::depth;
  std::string field;        // with By::field
  bool descending = false;  // false: the smallest key lies in front
};

}  // namespace splotchcl
