#include "floor_report.h"

#include <algorithm>

namespace splotchcl::bench {
namespace {

const char* const note =
    "GB: every array that a stage hands on is written once, which counts twice since lines of the "
    "cache\nare read first, and read once; those that hold a chunk only, at the bandwidth of "
    "arrays as large as\na chunk's entries. Not counted: tables, what a stage keeps for itself, "
    "planes once more for every\nchunk, all but the position of particles out of view. sort: "
    "passes of this radix sort; another one\nmay take fewer. Operations: of composite alone, the "
    "multiplications with an addition of its pixels, three\nin sums and nine in layers, in row "
    "parts (eight pixels of a row within a splat). What it takes to\nwork out shapes, and what "
    "other stages compute, is not counted, so that the least is lower than can\nbe reached. It "
    "is the larger one of both, for a frame drawn once.\n";

double measured_of(const FrameFloors& frame, const std::string& stage) {
  double seconds = 0;
  for (const StageTime& time : frame.measured)
    seconds += time.stage == stage ? time.seconds : 0;
  return seconds;
}

// Stages without a floor, such as copies.
double seconds_without_floor(const FrameFloors& frame, const std::vector<StageFloor>& floors) {
  double seconds = 0;
  for (const StageTime& time : frame.measured) {
    const bool has_floor = std::any_of(floors.begin(), floors.end(), [&](const StageFloor& floor) {
      return floor.stage == time.stage;
    });
    if (!has_floor) seconds += time.seconds;
  }
  return seconds;
}

StageFloor sum_of(const std::vector<StageFloor>& floors, double& least) {
  StageFloor sum;
  sum.stage = "all";
  for (const StageFloor& floor : floors) {
    sum.frame_bytes += floor.frame_bytes;
    sum.chunk_bytes += floor.chunk_bytes;
    sum.byte_seconds += floor.byte_seconds;
    sum.operation_seconds += floor.operation_seconds;
    least += floor.seconds();
  }
  return sum;
}

std::string seconds_or_none(double seconds) {
  return seconds > 0 ? fixed(seconds, 3) : "-";
}

std::vector<std::string> cells_of(const StageFloor& floor, double measured, double least,
                                  const std::string& goal) {
  return {floor.stage,
          fixed(measured, 3),
          fixed(1e-9 * floor.frame_bytes, 2),
          fixed(1e-9 * floor.chunk_bytes, 2),
          fixed(floor.byte_seconds, 3),
          seconds_or_none(floor.operation_seconds),
          fixed(least, 3),
          goal};
}

std::string work_of(const ListWork& work, const char* plan, const PatchSize& patch = {}) {
  if (work.entries == 0) return "";
  std::string text = std::string(plan) + ": " + fixed(1e-6 * work.entries, 2) + " M entries, " +
                     fixed(1e-6 * work.row_parts, 1) + " M row parts";
  if (patch.width > 0) {
    text += "; discs wider than 16 pixels reach into " + fixed(1e-6 * work.patches, 1) +
            " M patches of " + fixed(patch.width, 0) + "x" + fixed(patch.height, 0) + " pixels";
  }
  return text + "\n";
}

std::string heading_of(const FrameFloors& frame) {
  const MachineRates& rates = frame.rates;
  return frame.scene + ": " + fixed(frame.frame_seconds, 3) + " s for the frame, drawn " +
         (frame.drawings == 1 ? "once" : std::to_string(frame.drawings) + " times") +
         "; memory gives " + fixed(1e-9 * rates.memory_bandwidth, 1) + " GB/s, arrays of " +
         fixed(1e-6 * chunk_bytes(frame.counts), 0) + " MB " +
         fixed(1e-9 * rates.chunk_bandwidth, 1) + " GB/s\n" +
         work_of(frame.counts.summed, "sums", frame.counts.patch) +
         work_of(frame.counts.layered, "layers") + fixed(1e-9 * multiply_adds_of(frame.counts), 1) +
         " G multiply-adds, of which registers do " + fixed(1e-9 * rates.multiply_adds, 0) +
         " G/s\n\n";
}

// What stands between the frame and its goal.
std::string verdict_on(const FrameFloors& frame, const std::vector<StageFloor>& floors,
                       double least) {
  if (frame.goal_seconds <= 0) return "no goal\n";
  if (frame.frame_seconds <= frame.goal_seconds) return "the goal is met\n";
  std::string text = least > frame.goal_seconds
                         ? "the least of the stages forbids the goal: "
                         : "the least of the stages does not forbid the goal: ";
  text += fixed(least / frame.goal_seconds, 2) + " of it; seconds above their least:";
  for (const StageFloor& floor : floors)
    text += " " + floor.stage + " " + fixed(measured_of(frame, floor.stage) - floor.seconds(), 3);
  double of_stages = 0;
  for (const StageTime& time : frame.measured)
    of_stages += time.seconds;
  return text + ", between stages " + fixed(frame.frame_seconds - of_stages, 3) + "\n";
}

}  // namespace

void FloorReport::add(const FrameFloors& frame) {
  const std::vector<StageFloor> floors = floors_of(frame.counts, frame.rates);
  Table table({"stage", "measured s", "GB of the frame", "GB of chunks", "s of bytes",
               "s of operations", "least s", "goal s"});
  double measured = 0, least = 0;
  for (const StageFloor& floor : floors) {
    table.add(cells_of(floor, measured_of(frame, floor.stage), floor.seconds(), "-"));
    add_to_csv(frame, floor, measured_of(frame, floor.stage));
    measured += measured_of(frame, floor.stage);
  }
  if (const double others = seconds_without_floor(frame, floors); others > 0) {
    table.add({"others", fixed(others, 3), "-", "-", "-", "-", "-", "-"});
    measured += others;
  }
  const StageFloor sum = sum_of(floors, least);
  table.add(cells_of(sum, measured, least, seconds_or_none(frame.goal_seconds)));
  csv_.add({frame.scene, sum.stage, fixed(measured, 6), fixed(sum.frame_bytes, 0),
            fixed(sum.chunk_bytes, 0), fixed(sum.byte_seconds, 6), fixed(sum.operation_seconds, 6),
            fixed(least, 6), fixed(frame.goal_seconds, 6)});
  frames_ += heading_of(frame) + table.text() + "\n" + verdict_on(frame, floors, least) + "\n";
}

void FloorReport::add_to_csv(const FrameFloors& frame, const StageFloor& floor, double measured) {
  csv_.add({frame.scene, floor.stage, fixed(measured, 6), fixed(floor.frame_bytes, 0),
            fixed(floor.chunk_bytes, 0), fixed(floor.byte_seconds, 6),
            fixed(floor.operation_seconds, 6), fixed(floor.seconds(), 6), ""});
}

std::string FloorReport::text() const {
  if (frames_.empty()) return "";
  return "\nThe least that stages could take, and what forbids the goals\n\n" + frames_ + note;
}

}  // namespace splotchcl::bench
