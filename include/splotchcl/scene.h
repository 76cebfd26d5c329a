#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/finish.h"
#include "splotchcl/light_model.h"
#include "splotchcl/map_settings.h"
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

// A scalar field as a scene names it. Missing limits come from the data.
struct FieldMap {
  std::string field;  // empty: none
  Scaling scaling = Scaling::linear;
  std::optional<double> minimum, maximum;  // before scaling, in the field's unit
  // Of the data, in per cent, 0 <= low < high <= 100, for limits that are missing; 0 and 100
  // are the smallest and largest value. Unset: 0.5 and 99.5.
  std::optional<std::array<double, 2>> percentiles = std::nullopt;
};

// One kind of matter: which particles, how large, how coloured, how bright.
struct Component {
  std::string name;              // for messages and settings; may be empty
  std::string snapshot;          // of its own; empty: the scene's
  std::vector<int> types = {0};  // Gadget particle types (0 to 31), drawn as one component
  ParticleSet select;            // not given: all
  ParticleSet exclude;           // not given: none
  // In its snapshot's coordinates: from where the field `radius` is measured, and what is
  // placed at the placement's origin.
  Vec3 center = {{0, 0, 0}};
  Placement placement;
  std::string size_field = "smoothing_length";
  double size_factor = 1;            // > 0
  std::optional<double> size_fixed;  // instead of a field, in length units, > 0
  FieldMap color;
  // A field of three values per particle: its own red, green and blue, in place of the
  // palette's emission. Empty: none.
  std::string color_vector;
  FieldMap intensity;
  std::optional<WeightModel> weight;  // unset: mass where masses are known, else constant
  std::string palette = "inferno";    // a name in palettes/ or a file
  // A palette whose colours are palette_A; empty: what `palette` says.
  std::string absorption_palette;
  double brightness = 1;  // >= 0
  Absorption absorption;
  std::optional<double> reference_column;  // the w that counts as 1, > 0; unset: from the data
};

// How rows and samples of a picture lie, and how 8 bits are made of a display value v.
//   upright   the sky direction is up, samples at the pixels' centres, round(255 v)
//   original  as the original program does: upside down, samples half a pixel to the left and,
//             in the picture as it stands, above; floor(256 v)
enum class PixelConvention { upright, original };

// The picture as a whole.
struct ImageSettings {
  int width = 1024;  // in pixels, 1 to 65536
  int height = 1024;
  std::array<double, 3> background = {0, 0, 0};  // linear light >= 0, white is 1
  double gamma = 1;                              // > 0: 8-bit files store value^(1/gamma)
  // A picture that stands behind everything, instead of the colour; empty: none.
  std::string background_image;
  PixelConvention convention = PixelConvention::upright;
  // Of files of whole numbers, 8 or 16. Unset: 8, and TIFF files hold floats.
  std::optional<int> bits = std::nullopt;
  // Whether 8 bits are dithered. Unset: yes, but not in the original's convention.
  std::optional<bool> dither = std::nullopt;
};

// What a scene is to look like that is chosen from the data (docs/looks.md).
//   press    as large simulations are shown in public: hue for temperature or age, light for the
//            column of matter, on a dark ground, with glow
//   classic  one palette for each kind of matter, light and hue together
//   paper    ink on white, to be printed
enum class Look { press, classic, paper };

// What a scene file says (docs/scene.md). Nothing in it depends on the data yet. Lengths and
// fields are in the snapshot's units.
struct Scene {
  std::string snapshot;  // empty with a sequence
  // Of a scene without components, which are to be chosen from the data. Unset: none is chosen.
  std::optional<Look> look;
  ReadSettings read;
  SequenceSettings time;  // a sequence of snapshots instead of one
  ImageSettings image;
  std::optional<Camera> camera;  // unset: chosen from the data
  std::optional<Stereo> stereo;  // unset: one picture
  KernelSettings kernel;
  SortOrder sort;
  PathSettings path;  // of films
  MovieSettings movie;
  double tolerance = 1e-3;  // as Frame has it
  PeriodicSettings periodic;
  FinishSettings finish;
  MapSettings map;
  std::vector<Component> components;
};

}  // namespace splotchcl
