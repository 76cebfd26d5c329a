#pragma once

#include <string>
#include <vector>

#include "floors.h"
#include "splotchcl/renderer.h"
#include "table.h"

namespace splotchcl::bench {

// What one frame took, and the least that it could.
struct FrameFloors {
  std::string scene;
  FrameCounts counts;
  MachineRates rates;
  std::vector<StageTime> measured;  // by stage, seconds of the device
  std::size_t drawings = 1;         // that the measured ones are of; a floor is of one
  double frame_seconds = 0;         // of the wall, what lies between the stages included
  double goal_seconds = 0;          // for these, of the machine of the moment; 0: there is none
};

// Stages held against their floors: a table for each frame, to be read, and one of all, as CSV.
class FloorReport {
 public:
  void add(const FrameFloors& frame);
  // With a note on what a floor is and is not; empty without frames.
  std::string text() const;
  // Throws DataError.
  void write_csv(const std::string& path) const { csv_.write_csv(path); }

 private:
  void add_to_csv(const FrameFloors& frame, const StageFloor& floor, double measured);

  std::string frames_;
  Table csv_{{"scene", "stage", "measured s", "frame bytes", "chunk bytes", "byte s", "operation s",
              "least s", "goal s"}};
};

}  // namespace splotchcl::bench
