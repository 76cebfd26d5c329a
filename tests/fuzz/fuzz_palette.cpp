#include "fuzz/fuzz.h"
#include "palette/palette_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    splotchcl::parse_palette(std::string(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const splotchcl::Error&) {
    // refused
  }
  return 0;
}
