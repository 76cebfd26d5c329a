#include "fuzz/fuzz.h"

int splotchcl::fuzz::fuzz_gadget(const std::uint8_t* data, std::size_t size) {
  splotchcl::fuzz::write_scratch(data, size);
  splotchcl::fuzz::read_as(splotchcl::gadget_binary_format());
  return 0;
}
