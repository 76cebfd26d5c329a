#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/finish.h"
#include "splotchcl/light_model.h"
#include "splotchcl/plan.h"
#include "splotchcl/renderer.h"

// A scene as the adversary changes it: a few groups of clouds in an arrangement that is hard, and
// what is around them. Everything is a number or a choice with a name, so that a search can change
// it and a file can hold it.
namespace splotchcl::adversary {

// How a group's clouds lie in the picture.
enum class Arrangement {
  point,    // all at one place
  ring,     // on a circle: all end in the pixel at its centre
  line,     // along a row: all end in the same rows
  lattice,  // a square grid of so many places
  sheet,    // the same over the whole picture and beyond
  corner,   // one in each of the four cells of a grid that meet in a corner
  scatter,  // anywhere
};

// Which light they give, and with it the plan.
enum class Light {
  emission,         // nothing absorbs
  proportional,     // E = A
  factor,           // E = q A
  ordered,          // absorption has a palette of its own
  gray,             // as in the original program
  stars_among_gas,  // groups with `star` only emit, the others absorb as well
  two_sources,      // groups with `star` have an E / A of their own
};

// As what kind of map a trial is drawn, if as one (docs/maps.md).
enum class MapKind { none, column, mean, dispersion, integral };

// How light is finished, if errors count as a display shows them (docs/finish.md).
struct Shown {
  double is_on = 0;      // 1
  double automatic = 0;  // 1: exposure and white are found
  double exposure = 0;   // stops
  double white = 1;
  double balance = 0;  // of white, in kelvin; 0: as drawn
  double bloom = 0, highlights = 0, saturation = 1, contrast = 1, pivot = 0.5;
};

struct CloudGroup {
  Arrangement arrangement = Arrangement::point;
  double places = 1;       // of the arrangement
  double copies = 1;       // clouds at each place
  double x = 0, y = 0;     // pixels from the middle of what is drawn
  double spread = 1;       // in sigma: the ring's radius, the lattice's spacing
  double sigma = 3;        // pixels
  double width_range = 1;  // the widest place's sigma, of the narrowest's
  double peak = 1;         // of one cloud: light, or optical depth, in the pixel of its centre
  double jitter = 0;       // of each place, in sigma
  double depth = 10;       // lengths from the camera
  double hue = 0;          // place on the palette
  double color = 1;        // of the particles' own colors; the peak stays
  double star = 0;         // 1: emits and does not absorb, in Light::stars_among_gas,
                           // or has star_source, in Light::two_sources
};

struct Trial {
  std::string kind;  // the class of trials that it belongs to
  Light light = Light::emission;
  Projection projection = Projection::orthographic;
  Sampling sampling = Sampling::mean;
  ToneCurve tone = ToneCurve::linear;
  MapKind map = MapKind::none;
  CompositeShape shape = CompositeShape::rows;
  double tolerance = 1e-3;
  double width = 64, height = 48;  // of what is drawn
  double picture_size = 0;         // of the picture that it is a crop of; 0: it is the whole
  double crop_x = 0, crop_y = 0;   // where in it, from 0 to 1
  double field_of_view = 60;       // degrees, of the whole picture
  double turned = 0;               // 1: the camera looks along no axis
  double background = 0;           // light; 0: none
  double source = 1;               // E / A where the light leaves that open
  double star_source = 1;          // that of stars, in Light::two_sources
  double tint = 0;                 // of what absorbs in Light::ordered: 1: red alone
  double knots = 2;                // of the palette, in two colors by turns
  double decades = 0;              // of the palette's range, which is logarithmic; 0: linear
  double cut = 0;                  // kernel.cut; 0: none
  double min_radius = 0;           // kernel.min_radius, in pixels
  double footprint = 0;            // kernel.footprint, in pixels
  double slabs = 0;                // of an ordered plan: at least so many; 0: as it is planned
  double own_colors = 0;           // 1: particles have colors of their own
  double around = 0;               // 1: the camera sees through clouds around it
  double certify = 0;              // 1: the picture's error is to have a bound
  double dome = 0;                 // 1: a fisheye of half of all directions and more
  double original = 0;             // 1: pixels lie as the original program's
  double eye = 0;                  // lengths beside the camera, of a stereo pair's eye; 0: none
  double left_eye = 0;             // 1: to the left
  double inset = 0;                // a part of the field of view, around a cloud; 0: all of it
  double between = 0;              // so far on the way between two snapshots; 0: in one
  double motion = 0;               // pixels that clouds move between them
  double box = 0;                  // side of the periodic box, in pixels; 0: none
  double slice = 0;                // 1: a map of the plane through the middle
  double signs = 0;                // 1: every other group's value is below 0
  double value_decades = 0;        // of a map's values, from hue 0 to 1
  double map_floor = 1e-3;         // of the mean
  double filler = 0;               // faint particles that lie outside, as most of a file may
  double period = 0;  // the groups' clouds are each so-many-th of the file; 0: the first ones
  double offset = 0;  // from this place in the file on
  double jitter_seed = 1;
  Shown shown;
  std::vector<CloudGroup> groups;
};

// A number of a trial or a group: its name in files, and what a search may make of it.
template <class Owner>
struct Gene {
  enum class Scale {
    fixed,        // is not changed
    linear,       //
    logarithmic,  // and 0 stays 0
    whole,        // the same, in whole numbers
  };
  const char* name;
  double Owner::*member;
  Scale scale;
  double low, high;
};
const std::vector<Gene<Trial>>& trial_genes();
const std::vector<Gene<CloudGroup>>& group_genes();
const std::vector<Gene<Shown>>& shown_genes();  // of trials where it is on

LightPlan plan_of(Light light);

const char* name(Arrangement arrangement);
const char* name(Light light);
const char* name(CompositeShape shape);

// Numbers of trials have so many significant digits, so that files hold them exactly.
constexpr int digits = 6;

// One line per number or choice; what has its default is left out.
std::string text_of(const Trial& trial);
// The inverse. Throws std::runtime_error that names the words it does not understand. A line that
// begins with # and a space is a comment.
Trial trial_of(const std::string& text);
// Changes what the text says, and adds its groups.
void set(const std::string& text, Trial& trial);

}  // namespace splotchcl::adversary
