#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace splotchcl::test {

// A file in NumPy's format: `header` is Python's dictionary, `data` what follows it.
std::string numpy_bytes(const std::string& header, const std::string& data, int version = 1);

// The header of a plain array.
std::string numpy_header(const std::string& type, const std::string& shape,
                         bool is_fortran_order = false);

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& entries,
                      bool is_packed);

}  // namespace splotchcl::test
