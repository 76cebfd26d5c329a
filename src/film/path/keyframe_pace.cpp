#include "film/path/keyframe_pace.h"

#include <algorithm>
#include <cstddef>

namespace splotchcl {
namespace {

bool stops_at(const Stop& stop) {
  return stop.is_eased || stop.dwell > 0;
}

}  // namespace

bool KeyframePace::changes(const std::vector<Stop>& stops) {
  return std::any_of(stops.begin(), stops.end(), stops_at);
}

double KeyframePace::place_at(double frame) const {
  const auto after = std::find_if(stops_.begin(), stops_.end(),
                                  [frame](const Stop& stop) { return stop.frame > frame; });
  if (after == stops_.begin() || after == stops_.end()) {
    return after == stops_.end() ? stops_.back().frame : frame;
  }
  const Stop &from = *(after - 1), &to = *after;
  const double begin = from.frame + from.dwell;
  if (frame <= begin) return from.frame;
  const double width = to.frame - begin, way = to.frame - from.frame;
  const double t = (frame - begin) / width;
  // The cubic of a way that has these speeds at its ends.
  const double first = stops_at(from) ? 0 : width, last = stops_at(to) ? 0 : width;
  const double moved =
      way * t * t * (3 - 2 * t) + first * t * (1 - t) * (1 - t) + last * t * t * (t - 1);
  return from.frame + moved;
}

}  // namespace splotchcl
