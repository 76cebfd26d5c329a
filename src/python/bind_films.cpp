#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/drawing.h"
#include "python/progress.h"
#include "splotchcl/film.h"

namespace splotchcl::python {
namespace {

const char* name_of(FilmState state) {
  switch (state) {
    case FilmState::complete:
      return "complete";
    case FilmState::complete_before:
      return "complete before";
    case FilmState::part_is_drawn:
      return "part is drawn";
    case FilmState::joined_by_another:
      break;
  }
  return "joined by another";
}

// The film's state, its number of frames, and notes.
py::tuple make(const std::filesystem::path& scene, const std::filesystem::path& output,
               const std::vector<std::string>& settings, const std::string& device,
               bool by_reference, const std::string& frames, const std::string& part,
               py::object report_to) {
  const Progress progress(std::move(report_to));
  std::vector<std::string> notes;
  FilmOptions options;
  options.scene = scene;
  options.output = output;
  options.settings = settings;
  options.device = device;
  options.by_reference = by_reference;
  options.frames = frames;
  options.part = part;
  FilmReport report;
  report.note = [&notes](const std::string& note) { notes.push_back(note); };
  report.progress = progress.function();
  report.frame = [&progress](int, std::size_t done, std::size_t total) {
    progress("drawing", static_cast<double>(done) / static_cast<double>(total));
  };
  const FilmResult result = without_python([&] { return make_film(options, report); });
  return py::make_tuple(name_of(result.state), result.frames, std::move(notes));
}

}  // namespace

void bind_films(py::module_& module) {
  module.def("make_film", &make);
}

}  // namespace splotchcl::python
