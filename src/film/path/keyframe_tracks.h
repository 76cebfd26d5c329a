#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl {

// The keys that a path's keyframes move, each along a curve through its values.
class KeyframeTracks {
 public:
  // Throws UsageError for values of a key that differ in kind, and for directions of length 0.
  explicit KeyframeTracks(const Scene& scene);

  // "key=value" for each key at a frame.
  std::vector<std::string> settings(double frame) const;

 private:
  std::map<std::string, std::function<std::string(double)>> tracks_;  // value at a place
};

}  // namespace splotchcl
