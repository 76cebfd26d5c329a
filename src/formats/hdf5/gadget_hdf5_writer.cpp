#include "formats/hdf5/gadget_hdf5_writer.h"

#include <array>

#include "common/unfinished_file.h"
#include "formats/hdf5/hdf5_writer.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr std::size_t type_count = 6;
constexpr double km_s_in_cm_s = 1e5;

void write_header(const Hdf5Writer& writer, const WrittenSnapshot& snapshot) {
  std::array<std::uint64_t, type_count> counts = {};
  for (const WrittenType& type : snapshot.types)
    counts.at(static_cast<std::size_t>(type.type)) = type.count;
  const int one = 1;
  const OpenGroup header = writer.create_group("Header");
  for (const char* name : {"NumPart_ThisFile", "NumPart_Total"}) {
    writer.write_attribute(header.id(), name, H5T_STD_U64LE, H5T_NATIVE_UINT64, type_count,
                           counts.data());
  }
  writer.write_numbers(header.id(), "MassTable", std::array<double, type_count>{});
  writer.write_attribute(header.id(), "NumFilesPerSnapshot", H5T_STD_I32LE, H5T_NATIVE_INT, 1,
                         &one);
  writer.write_number(header.id(), "Time", snapshot.time);
  writer.write_number(header.id(), "Redshift", 0);
  writer.write_number(header.id(), "BoxSize", 0);
  writer.write_number(header.id(), "HubbleParam", 1);
  writer.write_number(header.id(), "UnitLength_in_cm", kpc_in_cm);
  writer.write_number(header.id(), "UnitVelocity_in_cm_per_s", km_s_in_cm_s);
}

// As Gadget 4 does. Masses are areas, and colors and axes have no unit.
void write_unit(const Hdf5Writer& writer, hid_t dataset, const std::string& name) {
  const bool is_length =
      name == "Coordinates" || name == "SmoothingLength" || name == "OrbitRadius";
  const bool is_velocity = name == "Velocities";
  if (!is_length && !is_velocity) return;
  writer.write_number(dataset, "length_scaling", is_length ? 1 : 0);
  writer.write_number(dataset, "velocity_scaling", is_velocity ? 1 : 0);
  for (const char* const power : {"mass_scaling", "a_scaling", "h_scaling"})
    writer.write_number(dataset, power, 0);
}

void write_type(const Hdf5Writer& writer, const WrittenType& type) {
  const OpenGroup group = writer.create_group("PartType" + std::to_string(type.type));
  for (const WrittenField& field : type.fields) {
    const auto columns = static_cast<hsize_t>(field.values_per_particle);
    const auto size = static_cast<std::size_t>(type.count * columns);
    const std::vector<float> same(field.values.is_uniform() ? size : 0,
                                  field.values.uniform_value());
    const float* const values = field.values.is_uniform() ? same.data() : field.values.data();
    std::vector<hsize_t> shape = {type.count};
    if (columns > 1) shape.push_back(columns);
    const OpenDataset dataset = writer.write_dataset(group.id(), field.name, H5T_IEEE_F32LE,
                                                     H5T_NATIVE_FLOAT, shape, values);
    write_unit(writer, dataset.id(), field.name);
  }
  if (!type.ids.empty()) {
    writer.write_dataset(group.id(), "ParticleIDs", H5T_STD_U64LE, H5T_NATIVE_UINT64, {type.count},
                         type.ids.data());
  }
}

}  // namespace

void write_gadget_hdf5(const std::filesystem::path& path, const WrittenSnapshot& snapshot) {
  const Hdf5Silence silence;
  UnfinishedFile file(path);
  {
    Hdf5Writer writer(file.temporary_path(), path);
    write_header(writer, snapshot);
    for (const WrittenType& type : snapshot.types) {
      if (type.count > 0) write_type(writer, type);
    }
    writer.finish();
  }
  file.finish();
}

}  // namespace splotchcl
