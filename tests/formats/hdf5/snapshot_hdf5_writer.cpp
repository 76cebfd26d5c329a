#include "formats/hdf5/snapshot_hdf5_writer.h"

#include <hdf5.h>

#include <map>

#include "formats/hdf5/hdf5_file.h"

namespace splotchcl::test {
namespace {

using Attribute = Hdf5Handle<H5Aclose>;
using Dataset = Hdf5Handle<H5Dclose>;
using File = Hdf5Handle<H5Fclose>;
using Group = Hdf5Handle<H5Gclose>;
using PropertyList = Hdf5Handle<H5Pclose>;
using Space = Hdf5Handle<H5Sclose>;

Space array_space(std::size_t size) {
  const hsize_t length = size;
  return Space(H5Screate_simple(1, &length, nullptr));
}

void write_attribute(const Group& group, const std::string& name, hid_t type, const Space& space,
                     const void* values) {
  const Attribute attribute(
      H5Acreate2(group.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT));
  H5Awrite(attribute.id(), type, values);
}

class HeaderWriter {
 public:
  HeaderWriter(const Group& group, const Hdf5Style& style) : group_(group), style_(style) {}

  void number(const std::string& name, double value) const {
    write_attribute(group_, name, H5T_NATIVE_DOUBLE,
                    style_.has_array_scalars ? array_space(1) : Space(H5Screate(H5S_SCALAR)),
                    &value);
  }
  void counts(const std::string& name, std::vector<std::uint32_t> values) const {
    values.resize(style_.types_in_header);
    const std::vector<double> doubles(values.begin(), values.end());
    const Space space = array_space(values.size());
    if (style_.has_double_counts) {
      write_attribute(group_, name, H5T_NATIVE_DOUBLE, space, doubles.data());
    } else {
      write_attribute(group_, name, H5T_NATIVE_UINT32, space, values.data());
    }
  }
  void numbers(const std::string& name, std::vector<double> values) const {
    values.resize(style_.types_in_header);
    write_attribute(group_, name, H5T_NATIVE_DOUBLE, array_space(values.size()), values.data());
  }

 private:
  const Group& group_;
  const Hdf5Style& style_;
};

void write_header(const File& file, const TestSnapshot& snapshot, const Hdf5Style& style) {
  const Group group(H5Gcreate2(file.id(), "Header", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  const HeaderWriter header(group, style);
  header.counts("NumPart_ThisFile", snapshot.counts);
  header.counts("NumPart_Total", {snapshot.total_counts.begin(), snapshot.total_counts.end()});
  if (!snapshot.high_words.empty()) header.counts("NumPart_Total_HighWord", snapshot.high_words);
  header.numbers("MassTable", snapshot.table_masses);
  header.number("Time", snapshot.time);
  header.number("Redshift", snapshot.redshift);
  header.number("BoxSize", snapshot.box_size);
  header.number("NumFilesPerSnapshot", snapshot.files);
  const Group parameters(
      style.has_parameters_group
          ? H5Gcreate2(file.id(), "Parameters", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)
          : H5Gopen2(file.id(), "Header", H5P_DEFAULT));
  const HeaderWriter cosmology(parameters, style);
  cosmology.number("Omega0", snapshot.omega_matter);
  cosmology.number("HubbleParam", snapshot.hubble_parameter);
  if (style.has_parameters_group) {
    cosmology.number("UnitLength_in_cm", 3.085678e21);
    cosmology.number("UnitMass_in_g", 1.989e43);
    cosmology.number("UnitVelocity_in_cm_per_s", 1e5);
  }
}

std::string dataset_name(const std::string& label) {
  static const std::map<std::string, std::string> names = {
      {"POS", "Coordinates"},      {"VEL", "Velocities"},
      {"ID", "ParticleIDs"},       {"MASS", "Masses"},
      {"U", "InternalEnergy"},     {"RHO", "Density"},
      {"HSML", "SmoothingLength"}, {"POT", "Potential"},
      {"ACCE", "Acceleration"},    {"AGE", "StellarFormationTime"}};
  const auto found = names.find(label);
  return found == names.end() ? label : found->second;
}

hid_t file_type(ValueKind kind) {
  if (kind == ValueKind::float64) return H5T_IEEE_F64LE;
  if (kind == ValueKind::uint32) return H5T_STD_U32LE;
  if (kind == ValueKind::uint64) return H5T_STD_U64LE;
  return H5T_IEEE_F32LE;
}

void write_dataset(const Group& group, const TestBlock& block, std::size_t type,
                   const Hdf5Style& style) {
  const std::vector<double>& values = block.values[type];
  const auto width = static_cast<hsize_t>(block.values_per_particle);
  std::vector<hsize_t> shape = {values.size() / width};
  if (width > 1) shape.push_back(width);
  const Space space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
  const PropertyList properties(H5Pcreate(H5P_DATASET_CREATE));
  if (style.is_compressed) {
    std::vector<hsize_t> chunk = shape;
    chunk[0] = 8;
    H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_deflate(properties.id(), 6);
  }
  const Dataset dataset(H5Dcreate2(group.id(), dataset_name(block.label).c_str(),
                                   file_type(block.kind), space.id(), H5P_DEFAULT, properties.id(),
                                   H5P_DEFAULT));
  H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  if (style.has_parameters_group && block.label == "POS") {
    const double one = 1;
    const Attribute attribute(H5Acreate2(dataset.id(), "length_scaling", H5T_NATIVE_DOUBLE,
                                         Space(H5Screate(H5S_SCALAR)).id(), H5P_DEFAULT,
                                         H5P_DEFAULT));
    H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, &one);
  }
}

}  // namespace

void write_hdf5(const std::filesystem::path& path, const TestSnapshot& snapshot,
                const Hdf5Style& style) {
  const File file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  write_header(file, snapshot, style);
  for (std::size_t type = 0; type < 6; ++type) {
    std::string name = "PartType";
    name += static_cast<char>('0' + type);
    Group group;
    for (const TestBlock& block : snapshot.blocks) {
      if (block.values[type].empty()) continue;
      if (!group.is_valid()) {
        group = Group(H5Gcreate2(file.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      }
      write_dataset(group, block, type, style);
    }
  }
}

}  // namespace splotchcl::test
