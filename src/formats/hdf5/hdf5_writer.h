#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_file.h"

namespace splotchcl {

using OpenDataset = Hdf5Handle<H5Dclose>;
using OpenGroup = Hdf5Handle<H5Gclose>;

// A new HDF5 file. What cannot be written is a DataError that names `path`, which the file at
// `temporary` becomes once it is whole.
class Hdf5Writer {
 public:
  Hdf5Writer(const std::filesystem::path& temporary, const std::filesystem::path& path);

  hid_t file() const { return file_.id(); }
  OpenGroup create_group(const std::string& name) const;
  // Values of a type in memory as one in the file, of a shape: rows, columns, ...
  OpenDataset write_dataset(hid_t in, const std::string& name, hid_t file_type, hid_t memory_type,
                            const std::vector<hsize_t>& shape, const void* values) const;
  // One value is a scalar.
  void write_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type,
                       hsize_t count, const void* values) const;
  void write_number(hid_t object, const std::string& name, double value) const;
  template <std::size_t count>
  void write_numbers(hid_t object, const std::string& name,
                     const std::array<double, count>& values) const {
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, count, values.data());
  }
  // In UTF-8.
  void write_text(hid_t object, const std::string& name, const std::string& text) const;
  // Closing flushes; a full disk shows only then. Call it last, when all else of it is closed.
  void finish();

 private:
  template <typename Result>
  Result require(Result result, const std::string& what) const;

  std::filesystem::path path_;
  Hdf5Handle<H5Fclose> file_;
};

}  // namespace splotchcl
