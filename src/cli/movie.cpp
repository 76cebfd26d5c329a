#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/film_manifest.h"
#include "cli/film_scene.h"
#include "cli/frame_loop.h"
#include "film/movie/encoder.h"
#include "film/movie/frame_files.h"
#include "film/movie/frame_range.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/picture.h"

namespace splotchcl::cli {
namespace {

std::vector<PictureSize> sizes_of(const Scene& scene) {
  return picture_sizes(scene, scene.image.width, scene.image.height);
}

std::vector<std::string> suffixes_of(const Scene& scene) {
  std::vector<std::string> suffixes;
  for (const PictureSize& size : sizes_of(scene))
    suffixes.push_back(size.suffix);
  return suffixes;
}

// Everything that the pictures can fail by is tried before anything is read.
void check_pictures(const FrameFiles& files, const Scene& scene) {
  files.check();
  for (const PictureSize& size : sizes_of(scene)) {
    if (files.is_film()) {
      check_film(files.film(size.suffix), scene.movie, size.width, size.height);
    } else {
      check_image_size(files.picture(0, size.suffix), size.width, size.height);
    }
  }
}

// The bytes that a PNG file holds.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  const Image image = read_image(path);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) bytes.push_back(static_cast<std::uint8_t>(255 * image.pixels[i] + 0.5F));
  }
  return bytes;
}

void join(const std::vector<int>& frames, const Scene& scene, const FrameFiles& files,
          Console& console) {
  for (const PictureSize& size : sizes_of(scene)) {
    Encoder encoder(files.film(size.suffix), scene.movie, size.width, size.height, files.folder());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      console.progress("joining the frames",
                       static_cast<double>(i) / static_cast<double>(frames.size()));
      encoder.add(read_bytes(files.picture(frames[i], size.suffix)));
    }
    encoder.finish();
  }
}

std::vector<int> missing(const std::vector<int>& frames, const FrameFiles& files) {
  std::vector<int> result;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(result),
               [&](int frame) { return !files.has(frame); });
  return result;
}

// Makes the film where all its frames are there; else says what to do.
void complete(const MovieOptions& options, const std::vector<int>& frames, const Scene& scene,
              FrameFiles& files, Console& console) {
  const std::size_t lacking = missing(frames, files).size();
  if (lacking > 0 && options.join) {
    throw DataError(fmt::format("{}: {} of {} frames are missing; draw the parts that are left",
                                files.folder().string(), lacking, frames.size()));
  }
  if (lacking > 0) {
    console.done(
        fmt::format("part {} is drawn; the last part, or splotchcl movie --join, makes "
                    "the film",
                    options.part));
    return;
  }
  const FrameFiles::Lock lock(files);
  if (!lock) return;  // another part is at it
  if (files.is_film()) join(frames, scene, files, console);
  files.close();
  console.done(fmt::format("{}: {} frames of {}x{} pixels", options.output.string(), frames.size(),
                           scene.image.width, scene.image.height));
}

// The last part has made the film already, or nobody has begun it.
void tell_of_nothing_to_join(const MovieOptions& options, const std::vector<int>& frames,
                             const FrameFiles& files, Console& console) {
  if (!files.is_complete(frames)) {
    throw DataError(options.output.string() +
                    ": found no frames to join, expected those of its parts; draw them first");
  }
  console.done(options.output.string() + " is complete already");
}

std::vector<std::string> settings_of(const MovieOptions& options) {
  std::vector<std::string> settings = options.settings;
  if (options.tolerance) settings.push_back(fmt::format("tolerance={}", *options.tolerance));
  return settings;
}

}  // namespace

int run_movie(const MovieOptions& options, Console& console) {
  FilmScene film(options.scene, settings_of(options));
  const Scene start = film.path().scene_at(film.scene(), 0);
  FrameFiles files(options.output, suffixes_of(start));
  check_pictures(files, start);
  const std::vector<int> frames = select_frames(options.frames, film.path().frame_count());
  const std::vector<int> part = select_part(options.part, frames);

  if (options.join && !files.is_begun()) {
    tell_of_nothing_to_join(options, frames, files, console);
    return 0;
  }
  console.status("reading");
  film.decide();
  files.open(film_manifest(film.scene(), film.path(), options.reference));
  if (!options.join) {
    const std::vector<int> to_draw = missing(part, files);
    files.remove_leftovers(to_draw);
    FrameLoop(options, film, files, console).draw(to_draw);
  }
  complete(options, frames, start, files, console);
  return 0;
}

}  // namespace splotchcl::cli
