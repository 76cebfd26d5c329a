#pragma once

#include <map>
#include <vector>

#include "splotchcl/finish.h"

namespace splotchcl {

// Exposure and white of a film that leaves them to its pictures, as some of its frames found them.
class FilmTone {
 public:
  // Each with an exposure and a white.
  void add(int frame, const FinishSettings& found) { found_[frame] = found; }
  bool is_empty() const { return found_.empty(); }

  // What the settings leave open. An exposure that follows the film goes straight from one of those
  // frames to the next, in stops, each of which is averaged with its neighbours, so that light
  // never jumps; any other is one for all frames, that of the brightest.
  void give_to(FinishSettings& finish, int frame) const;

 private:
  FinishSettings of_brightest() const;
  FinishSettings following(int frame) const;

  std::map<int, FinishSettings> found_;
};

// The frames, of so many, that are drawn to find it: the first, the last, and some between.
std::vector<int> frames_that_decide(int frames);

}  // namespace splotchcl
