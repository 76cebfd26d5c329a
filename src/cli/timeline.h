#pragma once

#include <filesystem>
#include <vector>

#include "splotchcl/renderer.h"

namespace splotchcl::cli {

// A part of the work on one frame of a film.
struct FilmSpan {
  int frame = 0;
  TimeSpan span;
};

// Events of Chrome's trace format, which Perfetto and chrome://tracing show: the device in one row;
// of the host reading in one, drawing frames by turns in two, writing in as many as write at a
// time. Microseconds from the earliest. The file appears only when complete.
void write_timeline(const std::filesystem::path& path, const std::vector<FilmSpan>& spans);

}  // namespace splotchcl::cli
