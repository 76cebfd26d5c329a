#include "formats/hdf5/hdf5_writer.h"
#include "map/map_files.h"

namespace splotchcl {
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
