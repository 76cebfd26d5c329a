#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/stored_values.h"

namespace splotchcl::test {

// A snapshot in memory, and writers for it that share no code with the readers.

struct TestBlock {
  std::string label;
  unsigned types = 0;  // bit t for type t
  int values_per_particle = 1;
  ValueKind kind = ValueKind::float32;
  std::vector<std::vector<double>> values;  // for each of the six types
};

struct TestSnapshot {
  std::vector<std::uint32_t> counts = std::vector<std::uint32_t>(6, 0);
  std::vector<std::uint64_t> total_counts = std::vector<std::uint64_t>(6, 0);
  // Instead of what the totals need: what some codes leave there.
  std::vector<std::uint32_t> high_words = {};
  std::vector<double> table_masses = std::vector<double>(6, 0);
  double time = 0.5;
  double redshift = 1;
  std::uint32_t flag_cooling = 0;
  std::uint32_t files = 1;
  double box_size = 100;
  double omega_matter = 0.3;
  double hubble_parameter = 0.7;
  std::vector<TestBlock> blocks;

  TestBlock& block(const std::string& label);
  void remove(const std::string& label);
  void set_kind(const std::string& label, ValueKind kind) { block(label).kind = kind; }
};

// Gas (37), halo particles with one mass in the table (20) and stars (11), with the blocks
// POS VEL ID MASS U RHO HSML POT ACCE HSMS AGE. Every value is different and exact in
// single precision.
TestSnapshot small_snapshot();

// Another block of different values.
void add_block(TestSnapshot& snapshot, const std::string& label, unsigned types,
               int values_per_particle);

// As `files` files: each has a part of each type.
std::vector<TestSnapshot> split(const TestSnapshot& snapshot, std::uint32_t files);

struct BinaryFile {
  std::string bytes;
  std::vector<std::size_t> block_ends;  // where the file could end without being cut
};
BinaryFile to_gadget(const TestSnapshot& snapshot, int format, bool is_swapped = false);

void write_bytes(const std::filesystem::path& path, const std::string& bytes);
void write_gadget(const std::filesystem::path& path, const TestSnapshot& snapshot, int format,
                  bool is_swapped = false);
// As base.0, base.1, ... (+ ending).
void write_gadget_set(const std::filesystem::path& base, const std::vector<TestSnapshot>& members,
                      int format);

}  // namespace splotchcl::test
