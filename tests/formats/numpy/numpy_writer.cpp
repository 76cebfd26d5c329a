#include "formats/numpy/numpy_writer.h"

#include <zip.h>

#include <stdexcept>

namespace splotchcl::test {

std::string numpy_bytes(const std::string& header, const std::string& data, int version) {
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  const std::size_t length = header.size() + 1;
  for (int byte = 0; byte < (version == 1 ? 2 : 4); ++byte) {
    bytes += static_cast<char>(length >> (8 * byte) & 0xff);
  }
  return bytes + header + "\n" + data;
}

std::string numpy_header(const std::string& type, const std::string& shape, bool is_fortran_order) {
  return "{'descr': '" + type + "', 'fortran_order': " + (is_fortran_order ? "True" : "False") +
         ", 'shape': " + shape + ", }";
}

std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& entries,
                      bool is_packed) {
  zip_source_t* const whole = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  zip_source_keep(whole);
  zip_t* const archive = zip_open_from_source(whole, ZIP_TRUNCATE, nullptr);
  if (archive == nullptr) throw std::runtime_error("no archive");
  for (const auto& [name, content] : entries) {
    zip_source_t* const source = zip_source_buffer(archive, content.data(), content.size(), 0);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_OVERWRITE);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(index),
                             is_packed ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 6);
  }
  if (zip_close(archive) != 0) throw std::runtime_error("the archive cannot be written");
  zip_source_open(whole);
  zip_source_seek(whole, 0, SEEK_END);
  std::string bytes(static_cast<std::size_t>(zip_source_tell(whole)), '\0');
  zip_source_seek(whole, 0, SEEK_SET);
  zip_source_read(whole, bytes.data(), bytes.size());
  zip_source_free(whole);
  return bytes;
}

}  // namespace splotchcl::test
