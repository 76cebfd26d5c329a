#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/finish.h"
#include "splotchcl/movie.h"
#include "splotchcl/palette.h"
#include "splotchcl/particles.h"
#include "splotchcl/path.h"
#include "splotchcl/periodic.h"
#include "splotchcl/read_settings.h"
#include "splotchcl/selection.h"
#include "splotchcl/sequence.h"
#include "splotchcl/stereo.h"

namespace splotchcl {

// Values are what scene files call linear, log and asinh: log is log10, of values
// > 0 only (others take the palette's first colour).
enum class Scaling { linear, log, asinh };

// What a particle's column w is made of before colour (docs/scene.md):
//   mass      w = m / (pi sigma^2)              a column density
//   density   w = rho sigma sqrt(pi)            the paper's rho_0 as a field
//   constant  w = 1 / h                         as in the original program
enum class WeightModel { mass, density, constant };

enum class Sampling {
  mean,    // a pixel's value is the mean over its area
  center,  // the value at the pixel's centre
};

// How much a component absorbs, as structure rather than as numbers, since the plan
// is made from it. e is brightness * I * palette_E.
//   as_emission      A = e, E = e                      (the default: E = A)
//   none             A = 0, E = e
//   factor           A = factor * I * palette_A, E = e
//   gray             A = e, E = e * e / (e + factor)   per channel, as in the original
struct Absorption {
  enum class Kind { as_emission, none, factor, gray };
  Kind kind = Kind::as_emission;
  double factor = 0;  // > 0 for factor, >= 0 for gray
};

// sigma = width * h. The uncut Gaussian with width 1/sqrt(20/3) has the second moment
// of the cubic spline of support h.
struct KernelSettings {
  double width = 0.3872983346207417;
  std::optional<double> cut;  // the cloud ends at cut * sigma; unset: never
  Sampling sampling = Sampling::mean;
  // h in pixels becomes h' = sqrt(h^2 + min_radius^2) and the weight is multiplied by
  // h / h', so small clouds gain light, as in the original. 0: off.
  double min_radius_pixels = 0;
};

// Which cloud lies in front. Nearest first; equal keys stay in component and file
// order, the earlier one in front.
struct SortOrder {
  enum class By { depth, field };
  By by = By::depth;
  std::string field;        // with By::field
  bool descending = false;  // false: the smallest key lies in front
};

// A scalar field as a scene names it. Missing limits come from the data.
struct FieldMap {
  std::string field;  // empty: none
  Scaling scaling = Scaling::linear;
  std::optional<double> minimum, maximum;  // before scaling
  // Of the data, in per cent, 0 <= low < high <= 100, for limits that are missing; 0 and 100
  // are the smallest and largest value. Unset: 0.5 and 99.5.
  std::optional<std::array<double, 2>> percentiles = std::nullopt;
};

// One kind of matter: which particles, how large, how coloured, how bright.
struct Component {
  std::string name;
  std::string snapshot;          // of its own; empty: the scene's
  std::vector<int> types = {0};  // Gadget particle types, drawn as one component
  ParticleSet select;            // not given: all
  ParticleSet exclude;           // not given: none
  // In its snapshot's coordinates: from where the field `radius` is measured, and what is
  // placed at the placement's origin.
  Vec3 center = {{0, 0, 0}};
  Placement placement;
  std::string size_field = "smoothing_length";
  double size_factor = 1;
  std::optional<double> size_fixed;  // instead of a field, in length units
  FieldMap color;
  // A field of three values per particle: its own red, green and blue, in place of the
  // palette's emission. Empty: none.
  std::string color_vector;
  FieldMap intensity;
  std::optional<WeightModel> weight;  // unset: mass where masses are known, else constant
  std::string palette = "inferno";    // a name in palettes/ or a file
  // A palette whose colours are palette_A; empty: what `palette` says.
  std::string absorption_palette;
  double brightness = 1;
  Absorption absorption;
  std::optional<double> reference_column;  // the w that counts as 1; unset: from the data
};

// How rows and samples of a picture lie, and how 8 bits are made of a value v.
//   upright   the sky direction is up, samples at the pixels' centres, round(255 v)
//   original  as the original program does: upside down, samples half a pixel to the left and,
//             in the picture as it stands, above; floor(256 v)
enum class PixelConvention { upright, original };

struct ImageSettings {
  int width = 1024;
  int height = 1024;
  std::array<double, 3> background = {0, 0, 0};
  double gamma = 1;  // 8-bit files store value^(1/gamma)
  // A picture that stands behind everything, instead of the colour; empty: none.
  std::string background_image;
  PixelConvention convention = PixelConvention::upright;
};

// What a scene file says. Nothing in it depends on the data yet.
struct Scene {
  std::string snapshot;  // empty with a sequence
  ReadSettings read;
  SequenceSettings time;  // a sequence of snapshots instead of one
  ImageSettings image;
  std::optional<Camera> camera;  // unset: chosen from the data
  std::optional<Stereo> stereo;  // unset: one picture
  KernelSettings kernel;
  SortOrder sort;
  PathSettings path;  // of films
  MovieSettings movie;
  double tolerance = 1e-3;
  PeriodicSettings periodic;
  FinishSettings finish;
  std::vector<Component> components;
};

}  // namespace splotchcl
