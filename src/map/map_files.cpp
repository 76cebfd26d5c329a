#include "map/map_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "common/unfinished_file.h"
#include "common/words.h"
#include "formats/hdf5/hdf5_writer.h"
#include "map/figure.h"
#include "map/shape.h"
#include "map/voxel_file.h"
#include "modules/module_file.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

// YAML in double quotes, on one line.
std::string quoted(const std::string& text) {
  std::string line = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') line += '\\';
    line += c == '\n' ? "\\n" : std::string(1, c);
  }
  return line + "\"";
}

// The enhanced CSV of astropy (APE 6): its header is YAML behind marks of comments.
std::string header_of(const Map& map, const MapMetadata& metadata) {
  const std::string length = fits_unit(map.axes[0].unit), value = fits_unit(map.unit);
  std::string header = "# %ECSV 1.0\n# ---\n# delimiter: ','\n# datatype:\n";
  const std::pair<const char*, const std::string*> columns[] = {
      {"inner", &length}, {"outer", &length}, {"value", &value}};
  for (const auto& [name, unit] : columns)
    header += fmt::format("# - {{name: {}, unit: {}, datatype: float64}}\n", name, quoted(*unit));
  header += fmt::format("# meta:\n#   quantity: {}\n", quoted(map.quantity));
  for (const auto& [key, text] : metadata)
    header += fmt::format("#   {}: {}\n", quoted(key), quoted(text));
  return header + "# schema: astropy-2.0\ninner,outer,value\n";
}

std::string plain_header(const Map& map) {
  return fmt::format("inner [{0}],outer [{0}],{1} [{2}]\n", map.axes[0].unit, map.quantity,
                     map.unit);
}

}  // namespace

std::string profile_as_text(const Map& map, bool with_header, const MapMetadata& metadata) {
  std::string text = with_header ? header_of(map, metadata) : plain_header(map);
  for (int i = 0; i < map.width; ++i) {
    const float value = map.values[static_cast<std::size_t>(i)];
    text += fmt::format("{:.9g},{:.9g},{}\n", map.axes[0].edge(i), map.axes[0].edge(i + 1),
                        std::isnan(value) ? "nan" : fmt::format("{:.9g}", value));
  }
  return text;
}

namespace {

bool is_fits(const std::string& ending) {
  return ending == ".fits" || ending == ".fit";
}

bool is_text_table(const std::string& ending) {
  return ending == ".csv" || ending == ".ecsv";
}

bool is_figure(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  return !(is_text_table(ending) || is_fits(ending) || is_hdf5_ending(ending) || ending == ".npy" ||
           ending == ".vdb" || ending == ".exr");
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

// A curve is shown as a whole.
MapSettings settings_of_figure(const Map& map, const MapSettings& settings) {
  MapSettings figure = settings;
  if (map.shape == MapShape::profile && !figure.percentiles) figure.percentiles = {{0, 100}};
  return figure;
}

// Most bins are, and none of them has a color.
Map without_empty_bins(const Map& map) {
  Map shown = map;
  std::replace(shown.values.begin(), shown.values.end(), 0.0F,
               std::numeric_limits<float>::quiet_NaN());
  return shown;
}

std::vector<std::string> write_figure(const std::filesystem::path& path, const Map& map,
                                      const Scene& scene, const SnapshotInfo& snapshot) {
  if (map.shape == MapShape::healpix && map.height == 1)
    return write_figure(path, picture_of_sphere(map, scene.image.width), scene, snapshot);
  const Map shown = map.shape == MapShape::histogram ? without_empty_bins(map) : map;
  const Figure figure = plan_figure(shown, settings_of_figure(map, scene.map));
  const bool has_axes = map.shape == MapShape::histogram || map.shape == MapShape::profile;
  if (lower_ending(path) == ".pdf") {
    write_bytes(path, encode_pdf(path, figure, scene, snapshot));
  } else if (has_axes) {
    write_image(path, draw_figure_with_axes(figure, scene, snapshot));
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

VoxelFile voxels_of(const Map& map, const MapMetadata& metadata) {
  VoxelFile voxels;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const MapAxis& of_map = map.axes[axis];
    voxels.size[axis] = of_map.cells;
    voxels.corner.a[axis] = of_map.edge(0);
    voxels.voxel.a[axis] = (of_map.edge(of_map.cells) - of_map.edge(0)) / of_map.cells;
  }
  voxels.values = upside_down(map.values, map.width, map.height);
  voxels.name = map.quantity;
  voxels.metadata = metadata;
  voxels.metadata["unit"] = map.unit;
  voxels.metadata["length_unit"] = map.length_unit;
  return voxels;
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

namespace {

bool is_cube(MapShape shape) {
  return shape == MapShape::velocities || shape == MapShape::voxels;
}

const char* cube_is_no_picture(MapShape shape) {
  return shape == MapShape::voxels ? "holds one map, not the planes of map.voxels"
                                   : "holds one map, not the channels of map.channels";
}

[[noreturn]] void refuse_shape(const std::filesystem::path& path, const char* why,
                               const char* expected) {
  throw UsageError(fmt::format("{}: {}, expected {}", path.string(), why, expected));
}

}  // namespace

void check_map_output(const std::filesystem::path& path, const Scene& scene,
                      const SnapshotInfo& snapshot) {
  const MapShape shape = shape_of(scene.map);
  const std::string ending = lower_ending(path);
  if (is_text_table(ending) && shape != MapShape::profile)
    refuse_shape(path, "holds a profile, not a map", ".fits, .hdf5 or .npy");
  if (ending == ".vdb") {
    if (shape != MapShape::voxels)
      refuse_shape(path, "holds the cube of map.voxels", ".fits, .hdf5 or .npy");
    require_voxel_files();
  }
  if (is_cube(shape) && (is_figure(path) || ending == ".exr"))
    refuse_shape(path, cube_is_no_picture(shape), ".fits, .hdf5 or .npy");
  if ((shape == MapShape::healpix || shape == MapShape::profile) && ending == ".exr")
    refuse_shape(path, "holds a map in a plane", ".fits, .hdf5, .npy or a figure");
  if (is_figure(path)) check_figure(scene, snapshot);
}

void check_map_path(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  if (is_fits(ending) || is_hdf5_ending(ending) || is_text_table(ending) || ending == ".npy" ||
      ending == ".vdb" || ending == ".pdf") {
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
  } else if (is_hdf5_ending(ending)) {
    UnfinishedFile file(path);
    write_hdf5(file.temporary_path(), path, map, snapshot, metadata);
    file.finish();
  } else if (ending == ".npy") {
    write_bytes(path, encode_npy(map));
  } else if (ending == ".vdb") {
    UnfinishedFile file(path);
    write_voxel_file(file.temporary_path(), voxels_of(map, metadata));
    file.finish();
  } else if (is_text_table(ending)) {
    const std::string text = profile_as_text(map, ending == ".ecsv", metadata);
    write_bytes(path, {text.begin(), text.end()});
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

namespace {

std::vector<int> npy_shape(const Map& map) {
  if (map.shape == MapShape::healpix) return {map.width};
  if (map.shape == MapShape::profile) return {map.width, 3};
  std::vector<int> shape = {map.height, map.width};
  if (!map.effective_particles.empty()) shape.insert(shape.begin(), 2);
  if (is_cube(map.shape)) shape.insert(shape.begin(), map.planes());
  return shape;
}

// The inner and the outer radius, and the value.
std::vector<float> profile_rows(const Map& map) {
  std::vector<float> rows;
  for (int i = 0; i < map.width; ++i) {
    rows.push_back(static_cast<float>(map.axes[0].edge(i)));
    rows.push_back(static_cast<float>(map.axes[0].edge(i + 1)));
    rows.push_back(map.values[static_cast<std::size_t>(i)]);
  }
  return rows;
}

}  // namespace

// Version 1.0 of NumPy's format: the header is padded so that the values begin at a multiple of 64
// bytes.
std::vector<unsigned char> encode_npy(const Map& map) {
  const std::vector<int> shape = npy_shape(map);
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}{}), }}",
                                   fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr std::size_t start = 10, alignment = 64;
  while ((start + header.size() + 1) % alignment != 0)
    header += ' ';
  header += '\n';

  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  std::vector<float> values = map.shape == MapShape::profile
                                  ? profile_rows(map)
                                  : upside_down(map.values, map.width, map.height);
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
  std::vector<hsize_t> shape = {static_cast<hsize_t>(map.width)};
  if (map.shape != MapShape::healpix && map.shape != MapShape::profile)
    shape.insert(shape.begin(), static_cast<hsize_t>(map.height));
  if (is_cube(map.shape)) shape.insert(shape.begin(), static_cast<hsize_t>(map.planes()));
  return writer.write_dataset(writer.file(), name, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape,
                              rows.data());
}

void write_extent(const Hdf5Writer& writer, hid_t values, const Map& map) {
  const double half_width = 0.5 * map.width * map.pixel, half_height = 0.5 * map.height * map.pixel;
  writer.write_text(values, "view", map.view);
  writer.write_numbers<4>(values, "extent",
                          {map.center_right - half_width, map.center_right + half_width,
                           map.center_up - half_height, map.center_up + half_height});
}

// The edges of all cells.
void write_axes(const Hdf5Writer& writer, const Map& map) {
  constexpr const char* names[] = {"x_edges", "y_edges", "z_edges"};
  for (std::size_t k = 0; k < map.axes.size(); ++k) {
    const MapAxis& axis = map.axes[k];
    std::vector<double> edges;
    for (int i = 0; i <= axis.cells; ++i)
      edges.push_back(axis.edge(i));
    const char* const name = map.shape == MapShape::profile ? "radius_edges" : names[k];
    const OpenDataset stored = writer.write_dataset(
        writer.file(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {edges.size()}, edges.data());
    writer.write_text(stored.id(), "name", axis.name);
    writer.write_text(stored.id(), "unit", axis.unit);
  }
}

}  // namespace

void write_hdf5(const std::filesystem::path& temporary, const std::filesystem::path& path,
                const Map& map, const SnapshotInfo& snapshot, const MapMetadata& metadata) {
  const Hdf5Silence silence;
  Hdf5Writer writer(temporary, path);
  OpenDataset values = write_plane(writer, "map", map, map.values);
  writer.write_text(values.id(), "quantity", map.quantity);
  writer.write_text(values.id(), "unit", map.unit);
  writer.write_text(values.id(), "length_unit", map.length_unit);
  writer.write_numbers<3>(values.id(), "center",
                          {map.center.a[0], map.center.a[1], map.center.a[2]});
  if (map.shape == MapShape::plane || map.shape == MapShape::velocities)
    write_extent(writer, values.id(), map);
  if (map.healpix) {
    const bool is_ring = map.healpix->order == HealpixOrder::ring;
    writer.write_text(values.id(), "ordering", is_ring ? "RING" : "NESTED");
    writer.write_number(values.id(), "nside", map.healpix->nside);
  }
  if (map.shell) writer.write_numbers<2>(values.id(), "shell", *map.shell);
  write_axes(writer, map);
  if (map.velocity) {
    writer.write_number(values.id(), "velocity_first", map.velocity->first);
    writer.write_number(values.id(), "velocity_step", map.velocity->step);
    writer.write_text(values.id(), "velocity_unit", map.velocity->unit);
  }
  if (map.sky) {
    writer.write_numbers<2>(values.id(), "sky", {map.sky->right_ascension, map.sky->declination});
    writer.write_number(values.id(), "degrees_per_pixel", map.sky->pixel);
    writer.write_text(values.id(), "projection", map.sky->projection);
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

namespace {

WriteVoxels& voxel_writer() {
  static auto* const writer = reinterpret_cast<WriteVoxels*>(
      module_entry("libsplotchcl_openvdb.so", voxel_writer_entry, ".vdb files need",
                   "it is built where OpenVDB is installed; write .npy or .hdf5 instead"));
  return *writer;
}

}  // namespace

void require_voxel_files() {
  (void)voxel_writer();
}

void write_voxel_file(const std::filesystem::path& path, const VoxelFile& voxels) {
  std::string problem;
  voxel_writer()(voxels, path.string(), problem);
  if (!problem.empty()) throw DataError(path.string() + ": cannot be written: " + problem);
}

}  // namespace splotchcl
