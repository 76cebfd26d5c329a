#include "fuzz/fuzz.h"

int splotchcl::fuzz::fuzz_numpy(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  fuzz::write_scratch(data, size);
  fuzz::read_as(numpy_format());
  fuzz::read_as(numpy_format(), {{"id", "z", "-", "x", "y"}});
  fuzz::read_as(numpy_format(), {}, "step=1");
  return 0;
}
