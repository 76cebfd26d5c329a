// Files of each format that is read byte by byte.
#include <vector>

#include "formats/halo_catalog.h"
#include "fuzz/fuzz.h"

namespace splotchcl::fuzz {

void fuzz_gadget(const std::uint8_t* data, std::size_t size) {
  write_scratch(data, size);
  read_as(gadget_binary_format());
}

// Lists of haloes as text, of AHF and Rockstar by their names.
void fuzz_halo_list(const std::uint8_t* data, std::size_t size) {
  for (const char* const ending : {".AHF_particles", ".AHF_halos", ".particles", ".list"}) {
    std::filesystem::path list = scratch_file();
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
}

void fuzz_numpy(const std::uint8_t* data, std::size_t size) {
  write_scratch(data, size);
  read_as(numpy_format());
  read_as(numpy_format(), {{"id", "z", "-", "x", "y"}});
  read_as(numpy_format(), {}, "step=1");
}

void fuzz_text(const std::uint8_t* data, std::size_t size) {
  write_scratch(data, size);
  read_as(text_table_format());
  read_as(text_table_format(), {{"x", "y", "z"}});
  read_as(text_table_format(), {{"id", "z", "-", "x", "y"}});
  read_as(text_table_format(), {{"x=1", "y=2", "z=c"}, 2});
  read_as(text_table_format(), {}, "step=1");
  try {
    text_table_format().groups_in(scratch_file(), "");
  } catch (const Error&) {
    // refused
  }
}

void fuzz_tipsy(const std::uint8_t* data, std::size_t size) {
  write_scratch(data, size);
  read_as(tipsy_format());
}

// An array beside a sound Tipsy file of three gas particles: as quantities, and as identifiers.
void fuzz_tipsy_array(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> snapshot(32 + 3 * 48, 0);
  for (const std::size_t place : {8U, 12U, 16U})  // particles, dimensions, gas
    snapshot[place] = 3;
  write_scratch(snapshot.data(), snapshot.size());
  for (const char* name : {".den", ".iord"}) {
    std::ofstream file(scratch_file().string() + name, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  read_as(tipsy_format());
}

}  // namespace splotchcl::fuzz
