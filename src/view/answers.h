#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/light_model.h"
#include "splotchcl/particles.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/vector.h"
#include "view/film_maker.h"
#include "view/frame_scheduler.h"
#include "view/view_drawer.h"
#include "view/view_scene.h"

namespace splotchcl::view {

// The place in space of what one sees at a place of the picture, in its pixels: the particle in the
// middle, by depth, of the matter whose clouds reach there. Nothing where no cloud does.
std::optional<Vec3> pick_particle(const Frame& frame, double x, double y);

// What the line of sight through a place of a picture meets of one component.
struct ProbedComponent {
  std::string name;
  double column = 0;  // of masses: mass over area, in the snapshot's units
  std::optional<double>
      mean;  // of the color field, weighted by the column; none: no field, no matter
};

struct Probe {
  std::optional<Vec3> position;  // what the pointer would pick
  std::optional<double> distance;
  std::vector<ProbedComponent> components;
};

// At x, y in pixels from the upper left corner.
Probe probe(const Frame& frame, double x, double y);

// Some particles of each component, in turn: x, y, z, x, ...
std::vector<double> some_places(const Frame& frame, std::size_t most);

// How many particles have which values. Bins are equally wide after scaling.
struct FieldHistogram {
  double minimum = 0, maximum = 0;    // of the values, before scaling
  std::vector<std::uint64_t> counts;  // empty: no value can be scaled
};

// Of at most 2 million values, evenly spaced in the column. `bins` > 0.
FieldHistogram field_histogram(const Column& column, Scaling scaling, std::size_t bins);

// What the program says to a page (docs/view.md, "What page and program say"): JSON, but for
// frames.

// What a page is told beside a picture.
struct FrameHeader {
  std::uint64_t frame = 0;  // to be acknowledged
  std::uint64_t state = 0;  // the page's number of the state that it shows
  FrameScheduler::Stage stage = FrameScheduler::Stage::preview;
  std::map<std::string, double> decided;  // keys that the state left open
  GivenWay given_way;
  std::string film_values = "{}";  // JSON: what keyframes set, as it is at the frame that is shown
};

// Binary: the number of bytes of the header, 4 bytes with the lowest first; the header as JSON; the
// picture's file.
std::string frame_message(const FrameHeader& header, const ViewPicture& picture);

// What a page is told of an error: words of a file, which messages quote, are left out.
std::string text_for_page(const std::exception& error);

// The state could not be drawn.
std::string state_error(std::uint64_t state, const std::string& text);
// A message could not be understood.
std::string message_error(const std::string& text);

std::string histogram_answer(std::uint64_t id, const FieldHistogram& histogram);
std::string pick_answer(std::uint64_t id, const Probe& probe);
std::string places_answer(std::uint64_t id, const std::vector<double>& places);
// `description`: as describe_component() gives it.
std::string component_answer(std::uint64_t id, const std::string& description);
// `settings`: JSON.
std::string settings_answer(std::uint64_t id, const std::string& settings);
std::string scene_text_answer(std::uint64_t id, const std::string& opened, const std::string& now);
// `path`: where it is, or would have been.
std::string save_answer(std::uint64_t id, SaveResult result, const std::string& path);
// How far a film is, for all pages.
std::string film_message(const FilmProgress& progress);
std::string question_error(std::uint64_t id, const std::string& text);

// What a page is told of the scene when it opens, as JSON: the value of every key that it may set,
// its components with the fields that they could show, and all palettes with their colors; and
// whether the picture may take the window's size and shape.
std::string describe_scene(const Scene& opened, const Snapshot& snapshot, bool fills_window);

// The same of a component that may be added to the scene: its keys are without "component.N.".
std::string describe_component(const Component& component, const Snapshot& snapshot);

// What another look, of which this is the scene, would set of the opened one: its light, and each
// component that is of the same particles.
std::string describe_look(const Scene& opened, const Scene& look);

// What keyframes of the scene set, of what a page may set.
std::set<std::string> keys_of_keyframes(const Scene& scene);
// The values of such keys, as JSON.
std::string describe_values(const Scene& scene, const std::set<std::string>& keys);

}  // namespace splotchcl::view
