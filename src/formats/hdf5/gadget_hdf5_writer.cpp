#include "formats/hdf5/gadget_hdf5_writer.h"

#include <array>

#include "common/unfinished_file.h"
#include "formats/hdf5/hdf5_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Attribute = Hdf5Handle<H5Aclose>;
using Dataset = Hdf5Handle<H5Dclose>;
using File = Hdf5Handle<H5Fclose>;
using Group = Hdf5Handle<H5Gclose>;
using Space = Hdf5Handle<H5Sclose>;

constexpr std::size_t type_count = 6;
constexpr double kpc_in_cm = 3.0856775814913673e21;
constexpr double km_s_in_cm_s = 1e5;

class Writer {
 public:
  Writer(const std::filesystem::path& path, const std::filesystem::path& temporary) : path_(path) {
    file_ = File(
        require(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), "the file"));
  }

  void write(const WrittenSnapshot& snapshot) {
    write_header(snapshot);
    for (const WrittenType& type : snapshot.types) {
      if (type.count > 0) write_type(type);
    }
    // Closing flushes; a full disk shows only then.
    require(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "the file");
  }

 private:
  template <typename Result>
  Result require(Result result, const std::string& what) const {
    if (result >= 0) return result;
    throw DataError(path_.string() + ": " + what +
                    " could not be written: is the disk full? Nothing was left behind");
  }

  void write_attribute(const Group& group, const char* name, hid_t file_type, hid_t memory_type,
                       const void* values, hsize_t count) {
    const Space space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
    const Attribute attribute(require(
        H5Acreate2(group.id(), name, file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT), name));
    require(H5Awrite(attribute.id(), memory_type, values), name);
  }
  void write_number(const Group& group, const char* name, double value) {
    write_attribute(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value, 1);
  }

  void write_header(const WrittenSnapshot& snapshot) {
    std::array<std::uint64_t, type_count> counts = {};
    for (const WrittenType& type : snapshot.types)
      counts.at(static_cast<std::size_t>(type.type)) = type.count;
    const std::array<double, type_count> no_masses = {};
    const int one = 1;
    const Group header(require(
        H5Gcreate2(file_.id(), "Header", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "the header"));
    for (const char* name : {"NumPart_ThisFile", "NumPart_Total"}) {
      write_attribute(header, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, counts.data(), type_count);
    }
    write_attribute(header, "MassTable", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, no_masses.data(),
                    type_count);
    write_attribute(header, "NumFilesPerSnapshot", H5T_STD_I32LE, H5T_NATIVE_INT, &one, 1);
    write_number(header, "Time", snapshot.time);
    write_number(header, "Redshift", 0);
    write_number(header, "BoxSize", 0);
    write_number(header, "HubbleParam", 1);
    write_number(header, "UnitLength_in_cm", kpc_in_cm);
    write_number(header, "UnitVelocity_in_cm_per_s", km_s_in_cm_s);
  }

  void write_type(const WrittenType& type) {
    const std::string name = "PartType" + std::to_string(type.type);
    const Group group(
        require(H5Gcreate2(file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), name));
    for (const WrittenField& field : type.fields) {
      const std::size_t size = static_cast<std::size_t>(type.count) *
                               static_cast<std::size_t>(field.values_per_particle);
      const std::vector<float> same(field.values.is_uniform() ? size : 0,
                                    field.values.uniform_value());
      const float* const values = field.values.is_uniform() ? same.data() : field.values.data();
      write_dataset(group, field.name, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, type.count,
                    field.values_per_particle, values);
    }
    if (!type.ids.empty()) {
      write_dataset(group, "ParticleIDs", H5T_STD_U64LE, H5T_NATIVE_UINT64, type.count, 1,
                    type.ids.data());
    }
  }

  void write_dataset(const Group& group, const std::string& name, hid_t file_type,
                     hid_t memory_type, std::uint64_t rows, int columns, const void* values) {
    const hsize_t shape[2] = {rows, static_cast<hsize_t>(columns)};
    const Space space(H5Screate_simple(columns > 1 ? 2 : 1, shape, nullptr));
    const Dataset dataset(require(H5Dcreate2(group.id(), name.c_str(), file_type, space.id(),
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                  name));
    require(H5Dwrite(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  }

  std::filesystem::path path_;
  File file_;
};

}  // namespace

void write_gadget_hdf5(const std::filesystem::path& path, const WrittenSnapshot& snapshot) {
  const Hdf5Silence silence;
  UnfinishedFile file(path);
  {
    Writer writer(path, file.temporary_path());
    writer.write(snapshot);
  }
  file.finish();
}

}  // namespace splotchcl
