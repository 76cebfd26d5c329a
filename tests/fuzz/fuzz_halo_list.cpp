#include "formats/halo_catalog.h"
#include "fuzz/fuzz.h"

// Lists of haloes as text, of AHF and Rockstar by their names.
int splotchcl::fuzz::fuzz_halo_list(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  for (const char* const ending : {".AHF_particles", ".AHF_halos", ".particles", ".list"}) {
    std::filesystem::path list = fuzz::scratch_file();
    list += ending;
    std::ofstream(list, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    for (const std::uint64_t number : {0U, 1U, 7U}) {
      try {
        read_halo(list, number, 1);
      } catch (const Error&) {
        // refused
      }
    }
  }
  return 0;
}
