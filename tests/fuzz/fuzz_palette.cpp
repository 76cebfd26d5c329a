#include "fuzz/fuzz.h"
#include "palette/palette_file.h"

// Some forms are told apart by their endings.
void splotchcl::fuzz::fuzz_palette(const std::uint8_t* data, std::size_t size) {
  const std::string content(reinterpret_cast<const char*>(data), size);
  for (const char* const name : {"fuzz.txt", "fuzz.cpt", "fuzz.act", "fuzz.lut"}) {
    try {
      splotchcl::parse_palette(content, name);
    } catch (const splotchcl::Error&) {
      // refused
    }
  }
}
