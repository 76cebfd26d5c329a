#include "common/unfinished_file.h"
#include "common/words.h"
#include "map/figure.h"
#include "map/map_files.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

bool is_fits(const std::string& ending) {
  return ending == ".fits" || ending == ".fit";
}
bool is_hdf5(const std::string& ending) {
  return ending == ".hdf5" || ending == ".h5";
}

bool is_figure(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  return !(is_fits(ending) || is_hdf5(ending) || ending == ".npy" || ending == ".exr");
}

constexpr const char* endings_of_maps =
    "expected .fits, .hdf5, .npy or .exr for the numbers, .pdf, .png or another picture of 8 bits "
    "for a figure";

void check_picture_ending(const std::filesystem::path& path, const std::string& ending) {
  try {
    check_image_bits(path, 8);  // knows the ending, and looks at nothing else
  } catch (const UsageError&) {
    throw UsageError(path.string() + ": found " +
                     (ending.empty() ? "no ending" : "the ending " + ending) +
                     ", which names no file of a map; " + endings_of_maps);
  }
}

void write_bytes(const std::filesystem::path& path, const std::vector<unsigned char>& bytes) {
  UnfinishedFile file(path);
  file.write(bytes.data(), bytes.size());
  file.finish();
}

std::vector<std::string> write_figure(const std::filesystem::path& path, const Map& map,
                                      const Scene& scene, const SnapshotInfo& snapshot) {
  const Figure figure = plan_figure(map, scene.map);
  if (lower_ending(path) == ".pdf") {
    write_bytes(path, encode_pdf(path, figure, scene, snapshot));
  } else {
    write_image(path, draw_figure(figure, scene, snapshot));
  }
  return figure.notes();
}

void write_as_exr(const std::filesystem::path& path, const Map& map,
                  const std::map<std::string, std::string>& metadata) {
  ImageFileOptions options;
  options.metadata = metadata;
  options.metadata["splotchcl:quantity"] = map.quantity;
  options.metadata["splotchcl:unit"] = map.unit;
  write_image(path, numbers_as_image(map), options);
}

}  // namespace

Image numbers_as_image(const Map& map) {
  Image image(map.width, map.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    image.pixels[4 * i] = map.values[i];
    if (!map.effective_particles.empty()) image.pixels[4 * i + 1] = map.effective_particles[i];
    image.pixels[4 * i + 3] = 1;
  }
  return image;
}

void check_map_output(const std::filesystem::path& path, const Scene& scene,
                      const SnapshotInfo& snapshot) {
  if (scene.map.channels > 0 && (is_figure(path) || lower_ending(path) == ".exr")) {
    throw UsageError(path.string() +
                     ": holds one map, not the channels of map.channels, expected .fits, .hdf5 or "
                     ".npy");
  }
  if (is_figure(path)) check_figure(scene, snapshot);
}

void check_map_path(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  if (is_fits(ending) || is_hdf5(ending) || ending == ".npy" || ending == ".pdf") {
    check_output_path(path);
  } else if (ending == ".tif" || ending == ".tiff" || ending == ".hdr") {
    throw UsageError(path.string() + ": holds light, not a map; " + endings_of_maps);
  } else {
    check_picture_ending(path, ending);
    check_image_path(path);
  }
}

std::vector<std::string> write_map(const std::filesystem::path& path, const Map& map,
                                   const Scene& scene, const SnapshotInfo& snapshot,
                                   const std::map<std::string, std::string>& metadata) {
  if (is_figure(path)) return write_figure(path, map, scene, snapshot);
  const std::string ending = lower_ending(path);
  if (is_fits(ending)) {
    write_bytes(path, encode_fits(path, map, snapshot, metadata));
  } else if (is_hdf5(ending)) {
    UnfinishedFile file(path);
    write_hdf5(file.temporary_path(), path, map, snapshot, metadata);
    file.finish();
  } else if (ending == ".npy") {
    write_bytes(path, encode_npy(map));
  } else {
    write_as_exr(path, map, metadata);
  }
  return {};
}

}  // namespace splotchcl
