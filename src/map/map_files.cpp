#include "map/map_files.h"

#include <fmt/format.h>

#include <cstring>

#include "common/unfinished_file.h"
#include "common/words.h"
#include "formats/hdf5/hdf5_writer.h"
#include "map/figure.h"
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

std::vector<float> upside_down(const std::vector<float>& values, int width, int height) {
  const auto row = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<float> turned;
  turned.reserve(values.size());
  for (std::size_t plane = 0; plane < values.size(); plane += row * rows) {
    for (std::size_t y = rows; y-- > 0;) {
      const float* const first = values.data() + plane + y * row;
      turned.insert(turned.end(), first, first + row);
    }
  }
  return turned;
}

// Version 1.0 of NumPy's format: the header is padded so that the values begin at a multiple of 64
// bytes.
std::vector<unsigned char> encode_npy(const Map& map) {
  const std::string planes = map.velocity ? fmt::format("{}, ", map.velocity->channels)
                             : map.effective_particles.empty() ? ""
                                                               : "2, ";
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}{}, {}), }}", planes,
                  map.height, map.width);
  constexpr std::size_t start = 10, alignment = 64;
  while ((start + header.size() + 1) % alignment != 0)
    header += ' ';
  header += '\n';

  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  std::vector<float> values = upside_down(map.values, map.width, map.height);
  const std::vector<float> second = upside_down(map.effective_particles, map.width, map.height);
  values.insert(values.end(), second.begin(), second.end());
  std::vector<unsigned char> file(bytes.size() + values.size() * sizeof(float));
  std::memcpy(file.data(), bytes.data(), bytes.size());
  std::memcpy(file.data() + bytes.size(), values.data(), values.size() * sizeof(float));
  return file;
}

namespace {

OpenDataset write_plane(const Hdf5Writer& writer, const char* name, const Map& map,
                        const std::vector<float>& values) {
  const std::vector<float> rows = upside_down(values, map.width, map.height);
  std::vector<hsize_t> shape = {static_cast<hsize_t>(map.height), static_cast<hsize_t>(map.width)};
  if (map.velocity) shape.insert(shape.begin(), static_cast<hsize_t>(map.velocity->channels));
  return writer.write_dataset(writer.file(), name, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape,
                              rows.data());
}

}  // namespace

void write_hdf5(const std::filesystem::path& temporary, const std::filesystem::path& path,
                const Map& map, const SnapshotInfo& snapshot, const MapMetadata& metadata) {
  const Hdf5Silence silence;
  Hdf5Writer writer(temporary, path);
  OpenDataset values = write_plane(writer, "map", map, map.values);
  writer.write_text(values.id(), "quantity", map.quantity);
  writer.write_text(values.id(), "unit", map.unit);
  const double half_width = 0.5 * map.width * map.pixel, half_height = 0.5 * map.height * map.pixel;
  writer.write_text(values.id(), "view", map.view);
  writer.write_text(values.id(), "length_unit", map.length_unit);
  writer.write_numbers<4>(values.id(), "extent",
                          {map.center_right - half_width, map.center_right + half_width,
                           map.center_up - half_height, map.center_up + half_height});
  writer.write_numbers<3>(values.id(), "center",
                          {map.center.a[0], map.center.a[1], map.center.a[2]});
  if (map.velocity) {
    writer.write_number(values.id(), "velocity_first", map.velocity->first);
    writer.write_number(values.id(), "velocity_step", map.velocity->step);
    writer.write_text(values.id(), "velocity_unit", map.velocity->unit);
  }
  if (map.sky) {
    writer.write_numbers<2>(values.id(), "sky", {map.sky->right_ascension, map.sky->declination});
    writer.write_number(values.id(), "degrees_per_pixel", map.sky->pixel);
  }
  writer.write_number(values.id(), "time", snapshot.time);
  if (snapshot.redshift) writer.write_number(values.id(), "redshift", *snapshot.redshift);
  writer.write_number(values.id(), "tolerance", map.tolerance);
  writer.write_number(values.id(), "floor", map.floor);
  if (!map.effective_particles.empty()) {
    (void)write_plane(writer, "effective_particles", map, map.effective_particles);
  }
  for (const auto& [key, text] : metadata)
    writer.write_text(writer.file(), key, text);
  values = {};
  writer.finish();
}

}  // namespace splotchcl
