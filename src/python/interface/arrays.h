#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "python/interface/casts.h"

namespace splotchcl::py {

// Values as numpy looks at them where they lie: what a property __array_interface__ gives. Python's
// limited interface has buffers from 3.11 on only.
struct ArrayLayout {
  const void* first = nullptr;
  const char* kind = "f4";  // of a value: f4, u8
  std::vector<std::int64_t> shape;
  std::vector<std::int64_t> strides = {};  // bytes; empty: C order
};

template <>
struct Cast<ArrayLayout> {
  // Read-only.
  static Object to(const ArrayLayout& layout);
};

// A numpy array of floats or doubles in C order, of the shape (N,) or (N, width). It lives as long
// as somebody has `owner`.
struct ArrayOfNumbers {
  const void* first = nullptr;
  bool is_double = false;
  std::uint64_t count = 0;
  int width = 1;
  std::shared_ptr<const void> owner;
};

template <>
struct Cast<ArrayOfNumbers> {
  static ArrayOfNumbers from(PyObject* object);
};

}  // namespace splotchcl::py
