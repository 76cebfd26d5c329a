#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "formats/hdf5/hdf5_file.h"

namespace splotchcl::test {

using Hdf5Output = Hdf5Handle<H5Fclose>;

inline Hdf5Output create_hdf5(const std::filesystem::path& path) {
  return Hdf5Output(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
}

// Rows of `width` values, with the groups on their way. `type` is that in the file.
inline void write_values(const Hdf5Output& file, const std::string& path,
                         const std::vector<double>& values, hsize_t width = 1,
                         hid_t type = H5T_IEEE_F64LE) {
  const hsize_t shape[2] = {values.size() / width, width};
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(width > 1 ? 2 : 1, shape, nullptr));
  const Hdf5Handle<H5Pclose> links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle<H5Dclose> dataset(
      H5Dcreate2(file.id(), path.c_str(), type, space.id(), links.id(), H5P_DEFAULT, H5P_DEFAULT));
  H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

// Records of floating-point members, row by row, as h5py and astropy write tables.
inline void write_records(const Hdf5Output& file, const std::string& path,
                          const std::vector<std::string>& members,
                          const std::vector<double>& values) {
  const hsize_t rows = values.size() / members.size();
  const Hdf5Handle<H5Tclose> record(H5Tcreate(H5T_COMPOUND, members.size() * sizeof(double)));
  for (std::size_t i = 0; i < members.size(); ++i)
    H5Tinsert(record.id(), members[i].c_str(), i * sizeof(double), H5T_NATIVE_DOUBLE);
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
  const Hdf5Handle<H5Pclose> links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), path.c_str(), record.id(), space.id(),
                                                links.id(), H5P_DEFAULT, H5P_DEFAULT));
  H5Dwrite(dataset.id(), record.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

// Lines of one length, as numpy's byte strings.
inline void write_lines(const Hdf5Output& file, const std::string& path,
                        const std::vector<std::string>& lines) {
  constexpr std::size_t length = 64;
  const hsize_t rows = lines.size();
  std::string bytes;
  for (const std::string& line : lines)
    bytes += line + std::string(length - line.size(), '\0');
  const Hdf5Handle<H5Tclose> type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), length);
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
  const Hdf5Handle<H5Pclose> links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), path.c_str(), type.id(), space.id(),
                                                links.id(), H5P_DEFAULT, H5P_DEFAULT));
  H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
}

inline void make_group(const Hdf5Output& file, const std::string& name) {
  const Hdf5Handle<H5Gclose> group(
      H5Gcreate2(file.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

inline void write_attribute(const Hdf5Output& file, const std::string& group,
                            const std::string& name, const std::vector<double>& values,
                            hid_t type = H5T_IEEE_F64LE) {
  const hsize_t length = values.size();
  const Hdf5Handle<H5Oclose> owner(H5Oopen(file.id(), group.c_str(), H5P_DEFAULT));
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &length, nullptr));
  const Hdf5Handle<H5Aclose> attribute(
      H5Acreate2(owner.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT));
  if (!values.empty()) H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
}

// As h5py writes a truth value: of an enumeration of bytes.
inline void write_truth(const Hdf5Output& file, const std::string& object, const std::string& name,
                        bool value) {
  const Hdf5Handle<H5Oclose> owner(H5Oopen(file.id(), object.c_str(), H5P_DEFAULT));
  const Hdf5Handle<H5Tclose> type(H5Tenum_create(H5T_STD_I8LE));
  for (const auto& [word, number] : {std::pair("FALSE", std::int8_t{0}), {"TRUE", std::int8_t{1}}})
    H5Tenum_insert(type.id(), word, &number);
  const Hdf5Handle<H5Sclose> space(H5Screate(H5S_SCALAR));
  const Hdf5Handle<H5Aclose> attribute(
      H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT));
  const auto byte = static_cast<std::int8_t>(value);
  H5Awrite(attribute.id(), type.id(), &byte);
}

// As h5py writes a text: UTF-8 of any length.
inline void write_text(const Hdf5Output& file, const std::string& object, const std::string& name,
                       const std::string& text) {
  const Hdf5Handle<H5Oclose> owner(H5Oopen(file.id(), object.c_str(), H5P_DEFAULT));
  const Hdf5Handle<H5Tclose> type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Hdf5Handle<H5Sclose> space(H5Screate(H5S_SCALAR));
  const Hdf5Handle<H5Aclose> attribute(
      H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT));
  const char* const content = text.c_str();
  H5Awrite(attribute.id(), type.id(), &content);
}

}  // namespace splotchcl::test
