#include "film/frames/film_tone.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "finish/tone.h"

namespace splotchcl {
namespace {

// In stops.
struct Levels {
  double exposure = 0, white = 0;
};

Levels operator+(const Levels& a, const Levels& b) {
  return {a.exposure + b.exposure, a.white + b.white};
}

Levels operator*(double factor, const Levels& levels) {
  return {factor * levels.exposure, factor * levels.white};
}

Levels levels_of(const FinishSettings& finish) {
  return {finish.exposure.value(), std::log2(finish.white.value())};
}

// The light, as drawn, that becomes white.
double white_light(const FinishSettings& finish) {
  return finish.white.value() * std::exp2(-finish.exposure.value());
}

using Found = std::map<int, FinishSettings>;

// Half of it, and a quarter of each neighbour; the ends are their own.
Levels averaged(const Found& found, Found::const_iterator at) {
  const auto before = at == found.begin() ? at : std::prev(at);
  const auto after = std::next(at) == found.end() ? at : std::next(at);
  return 0.5 * levels_of(at->second) +
         0.25 * (levels_of(before->second) + levels_of(after->second));
}

}  // namespace

void FilmTone::give_to(FinishSettings& finish, int frame) const {
  if (is_empty()) return;
  take_tone(finish.exposure_follows ? following(frame) : of_brightest(), finish);
}

FinishSettings FilmTone::of_brightest() const {
  return std::max_element(found_.begin(), found_.end(),
                          [](const auto& a, const auto& b) {
                            return white_light(a.second) < white_light(b.second);
                          })
      ->second;
}

FinishSettings FilmTone::following(int frame) const {
  auto after = found_.lower_bound(frame);
  if (after == found_.end()) after = std::prev(after);
  const auto before = after == found_.begin() || after->first <= frame ? after : std::prev(after);
  const int span = after->first - before->first;
  const double part = span > 0 ? static_cast<double>(frame - before->first) / span : 0;
  const Levels levels = (1 - part) * averaged(found_, before) + part * averaged(found_, after);
  FinishSettings finish = before->second;
  finish.exposure = levels.exposure;
  finish.white = std::exp2(levels.white);
  return finish;
}

std::vector<int> frames_that_decide(int frames) {
  constexpr int most = 32, frames_for_each = 8;
  const int last = frames - 1;
  const int steps = std::clamp(last / frames_for_each, std::min(2, last), most);
  std::vector<int> chosen;
  for (int i = 0; i <= steps; ++i)
    chosen.push_back(static_cast<int>(std::int64_t{last} * i / std::max(1, steps)));
  return chosen;
}

}  // namespace splotchcl
