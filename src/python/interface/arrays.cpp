#include "python/interface/arrays.h"

namespace splotchcl::py {
namespace {

constexpr char endianness = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? '<' : '>';
constexpr const char* expected = "a numpy array of floats or doubles in C order";

Object tuple_of_numbers(const std::vector<std::int64_t>& numbers) {
  std::vector<Object> objects;
  for (const std::int64_t number : numbers)
    objects.push_back(to(number));
  return tuple_of(std::move(objects));
}

Object item(const Object& dict, const char* key) {
  PyObject* const found = PyDict_GetItemString(dict.get(), key);
  if (found == nullptr) throw CastError{expected};
  return Object::borrowing(found);
}

// Lets go of the array with Python's lock, which whoever has its last column may lack.
std::shared_ptr<const void> shared(PyObject* array) {
  Py_INCREF(array);
  const auto let_go = [](PyObject* last) {
    const Lock lock;
    Py_DECREF(last);
  };
  return std::shared_ptr<PyObject>(array, let_go);
}

}  // namespace

Object Cast<ArrayLayout>::to(const ArrayLayout& layout) {
  constexpr bool is_read_only = true;
  Dict dict;
  dict.set("version", 3);
  dict.set("typestr", endianness + std::string(layout.kind));
  dict.set("shape", tuple_of_numbers(layout.shape));
  if (!layout.strides.empty()) dict.set("strides", tuple_of_numbers(layout.strides));
  dict.set("data", make_tuple(reinterpret_cast<std::uintptr_t>(layout.first), is_read_only));
  return dict.object();
}

ArrayOfNumbers Cast<ArrayOfNumbers>::from(PyObject* object) {
  if (PyObject_HasAttrString(object, "__array_interface__") == 0) throw CastError{expected};
  const Object layout = Object::borrowing(object).attribute("__array_interface__");
  const auto kind = py::from<std::string>(item(layout, "typestr").get());
  const auto shape = py::from<std::vector<std::int64_t>>(item(layout, "shape").get());
  const auto data = py::from<std::vector<Object>>(item(layout, "data").get());
  const std::string of_float = endianness + std::string("f4");
  const std::string of_double = endianness + std::string("f8");
  const bool is_known = kind == of_float || kind == of_double;
  // Strides are None in C order.
  if (!is_known || shape.empty() || shape.size() > 2 || !item(layout, "strides").is_none()) {
    throw CastError{expected};
  }
  ArrayOfNumbers array;
  array.first = reinterpret_cast<const void*>(py::from<std::uintptr_t>(data.at(0).get()));
  array.is_double = kind == of_double;
  array.count = static_cast<std::uint64_t>(shape[0]);
  array.width = shape.size() > 1 ? static_cast<int>(shape[1]) : 1;
  array.owner = shared(object);
  return array;
}

}  // namespace splotchcl::py
