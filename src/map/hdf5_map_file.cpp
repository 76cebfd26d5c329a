#include <hdf5.h>

#include <array>

#include "formats/hdf5/hdf5_file.h"
#include "map/map_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Attribute = Hdf5Handle<H5Aclose>;
using Dataset = Hdf5Handle<H5Dclose>;
using File = Hdf5Handle<H5Fclose>;
using Space = Hdf5Handle<H5Sclose>;
using Type = Hdf5Handle<H5Tclose>;

class Writer {
 public:
  Writer(const std::filesystem::path& temporary, const std::filesystem::path& path) : path_(path) {
    file_ = File(
        require(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), "the file"));
  }

  Dataset write_plane(const char* name, const Map& map, const std::vector<float>& values) {
    const hsize_t sides[2] = {static_cast<hsize_t>(map.height), static_cast<hsize_t>(map.width)};
    const Space space(require(H5Screate_simple(2, sides, nullptr), name));
    Dataset dataset(require(H5Dcreate2(file_.id(), name, H5T_IEEE_F32LE, space.id(), H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT),
                            name));
    const std::vector<float> rows = upside_down(values, map.width);
    require(H5Dwrite(dataset.id(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
            name);
    return dataset;
  }
  void write_text(hid_t object, const char* name, const std::string& text) {
    const Type type(require(H5Tcopy(H5T_C_S1), name));
    require(H5Tset_size(type.id(), text.size() + 1), name);
    require(H5Tset_cset(type.id(), H5T_CSET_UTF8), name);
    const Space space(require(H5Screate(H5S_SCALAR), name));
    write_attribute(object, name, type.id(), type.id(), space, text.c_str());
  }
  template <std::size_t count>
  void write_numbers(hid_t object, const char* name, const std::array<double, count>& values) {
    const hsize_t size = count;
    const Space space(
        require(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), name));
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, values.data());
  }
  // Closing flushes; a full disk shows only then.
  void finish() { require(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "the file"); }
  hid_t file() const { return file_.id(); }

 private:
  template <typename Result>
  Result require(Result result, const std::string& what) const {
    if (result >= 0) return result;
    throw DataError(path_.string() + ": " + what +
                    " could not be written: is the disk full? Nothing was left behind");
  }
  void write_attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type,
                       const Space& space, const void* values) {
    const Attribute attribute(
        require(H5Acreate2(object, name, file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT), name));
    require(H5Awrite(attribute.id(), memory_type, values), name);
  }

  const std::filesystem::path& path_;
  File file_;
};

}  // namespace

void write_hdf5(const std::filesystem::path& temporary, const std::filesystem::path& path,
                const Map& map, const MapMetadata& metadata) {
  const Hdf5Silence silence;
  Writer writer(temporary, path);
  const Dataset values = writer.write_plane("map", map, map.values);
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
  if (map.sky) {
    writer.write_numbers<2>(values.id(), "sky", {map.sky->right_ascension, map.sky->declination});
    writer.write_numbers<1>(values.id(), "degrees_per_pixel", {map.sky->pixel});
  }
  writer.write_numbers<1>(values.id(), "tolerance", {map.tolerance});
  writer.write_numbers<1>(values.id(), "floor", {map.floor});
  if (!map.effective_particles.empty()) {
    (void)writer.write_plane("effective_particles", map, map.effective_particles);
  }
  for (const auto& [key, text] : metadata)
    writer.write_text(writer.file(), key.c_str(), text);
  writer.finish();
}

}  // namespace splotchcl
