#include <vector>

#include "fuzz/fuzz.h"

// An array beside a sound Tipsy file of three gas particles: as quantities, and as identifiers.
int splotchcl::fuzz::fuzz_tipsy_array(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  std::vector<std::uint8_t> snapshot(32 + 3 * 48, 0);
  for (const std::size_t place : {8U, 12U, 16U})  // particles, dimensions, gas
    snapshot[place] = 3;
  fuzz::write_scratch(snapshot.data(), snapshot.size());
  for (const char* name : {".den", ".iord"}) {
    std::ofstream file(fuzz::scratch_file().string() + name, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  fuzz::read_as(tipsy_format());
  return 0;
}
