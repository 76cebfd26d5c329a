#include "formats/hdf5/hdf5_writer.h"

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Attribute = Hdf5Handle<H5Aclose>;
using Properties = Hdf5Handle<H5Pclose>;
using Space = Hdf5Handle<H5Sclose>;
using Type = Hdf5Handle<H5Tclose>;

// The same call writes the same file.
Properties without_times(hid_t of) {
  Properties properties(H5Pcreate(of));
  H5Pset_obj_track_times(properties.id(), false);
  return properties;
}

}  // namespace

template <typename Result>
Result Hdf5Writer::require(Result result, const std::string& what) const {
  if (result >= 0) return result;
  throw DataError(path_.string() + ": " + what +
                  " could not be written: is the disk full? Nothing was left behind");
}

Hdf5Writer::Hdf5Writer(const std::filesystem::path& temporary, const std::filesystem::path& path)
    : path_(path),
      file_(require(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                    "the file")) {}

OpenGroup Hdf5Writer::create_group(const std::string& name) const {
  const Properties timeless = without_times(H5P_GROUP_CREATE);
  return OpenGroup(
      require(H5Gcreate2(file_.id(), name.c_str(), H5P_DEFAULT, timeless.id(), H5P_DEFAULT), name));
}

OpenDataset Hdf5Writer::write_dataset(hid_t in, const std::string& name, hid_t file_type,
                                      hid_t memory_type, const std::vector<hsize_t>& shape,
                                      const void* values) const {
  const Space space(
      require(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), name));
  const Properties timeless = without_times(H5P_DATASET_CREATE);
  OpenDataset dataset(require(
      H5Dcreate2(in, name.c_str(), file_type, space.id(), H5P_DEFAULT, timeless.id(), H5P_DEFAULT),
      name));
  require(H5Dwrite(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  // Small ones wait to be written until they are closed, where nobody hears of a full disk.
  require(H5Dflush(dataset.id()), name);
  return dataset;
}

void Hdf5Writer::write_attribute(hid_t object, const std::string& name, hid_t file_type,
                                 hid_t memory_type, hsize_t count, const void* values) const {
  const Space space(
      require(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), name));
  const Attribute attribute(require(
      H5Acreate2(object, name.c_str(), file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT), name));
  require(H5Awrite(attribute.id(), memory_type, values), name);
}

void Hdf5Writer::write_number(hid_t object, const std::string& name, double value) const {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &value);
}

void Hdf5Writer::write_text(hid_t object, const std::string& name, const std::string& text) const {
  const Type type(require(H5Tcopy(H5T_C_S1), name));
  require(H5Tset_size(type.id(), text.size() + 1), name);
  require(H5Tset_cset(type.id(), H5T_CSET_UTF8), name);
  write_attribute(object, name, type.id(), type.id(), 1, text.c_str());
}

void Hdf5Writer::finish() {
  require(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "the file");
  require(file_.close(), "the file");
}

}  // namespace splotchcl
