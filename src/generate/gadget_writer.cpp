#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

#include "common/unfinished_file.h"
#include "generate/gadget_files.h"
#include "splotchcl/error.h"
#include "splotchcl/generate.h"

namespace splotchcl {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "values are written as they lie in memory");

constexpr std::size_t gas = 0, stars = 4;  // Gadget's particle types

struct Header {
  std::array<std::uint32_t, 6> count_in_file = {};
  std::array<double, 6> mass_table = {};  // 0: masses are in the MASS block
  double time = 1, redshift = 0;
  std::int32_t flag_star_formation = 0, flag_feedback = 0;
  std::array<std::uint32_t, 6> count_in_all = {};
  std::int32_t flag_cooling = 0, files = 1;
  double box_size = 0, omega_matter = 0.3, omega_lambda = 0.7, hubble_parameter = 0.7;
  std::int32_t flag_stellar_age = 1, flag_metals = 0;
  std::array<std::uint32_t, 6> count_in_all_high = {};
  std::int32_t flag_entropy = 0;
  std::array<char, 60> unused = {};
};
static_assert(sizeof(Header) == 256);

// Record lengths have 32 bits: the longest record has three floats for each particle, and
// the label before it counts its two marks too.
constexpr std::uint64_t most_particles =
    (std::numeric_limits<std::uint32_t>::max() - 8) / (3 * sizeof(float));

// A record is its length, its bytes, its length.
class RecordWriter {
 public:
  explicit RecordWriter(UnfinishedFile& file) : file_(file) {}

  // The record before each block holds its label and the length of what follows.
  void begin_block(const char* label, std::size_t bytes) {
    const auto length = static_cast<std::uint32_t>(bytes);
    write(std::uint32_t{8});
    file_.write(label, 4);
    write(length + 8);
    write(std::uint32_t{8});
    write(length);
    length_ = length;
  }
  void write_values(const std::vector<float>& values) {
    file_.write(values.data(), values.size() * sizeof(float));
  }
  void end_block() { write(length_); }

  void write_header(const Header& header) {
    begin_block("HEAD", sizeof header);
    write(header);
    end_block();
  }
  // Values of one type, or of gas and stars one after the other.
  void write_block(const char* label, const std::vector<float>& first,
                   const std::vector<float>& second = {}) {
    if (first.empty() && second.empty()) return;
    begin_block(label, (first.size() + second.size()) * sizeof(float));
    write_values(first);
    write_values(second);
    end_block();
  }

 private:
  template <typename T>
  void write(const T& value) {
    file_.write(&value, sizeof value);
  }

  UnfinishedFile& file_;
  std::uint32_t length_ = 0;
};

Header make_header(const GeneratedSnapshot& snapshot, const GadgetSet& set) {
  Header header;
  header.count_in_file[gas] = static_cast<std::uint32_t>(snapshot.gas.count());
  header.count_in_file[stars] = static_cast<std::uint32_t>(snapshot.stars.count());
  header.count_in_all[gas] = static_cast<std::uint32_t>(set.gas);
  header.count_in_all[stars] = static_cast<std::uint32_t>(set.stars);
  header.count_in_all_high[gas] = static_cast<std::uint32_t>(set.gas >> 32U);
  header.count_in_all_high[stars] = static_cast<std::uint32_t>(set.stars >> 32U);
  header.files = static_cast<std::int32_t>(set.files);
  header.box_size = snapshot.box_size;
  return header;
}

std::vector<float> masses(const GeneratedParticles& particles) {
  return std::vector<float>(particles.count(), particles.mass);
}

void write_ids(RecordWriter& writer, UnfinishedFile& file, std::uint64_t count,
               std::uint32_t first) {
  std::vector<std::uint32_t> ids(count);
  std::iota(ids.begin(), ids.end(), first);
  writer.begin_block("ID  ", ids.size() * sizeof ids[0]);
  file.write(ids.data(), ids.size() * sizeof ids[0]);
  writer.end_block();
}

void write_blocks(UnfinishedFile& file, const GeneratedSnapshot& snapshot, const Header& header,
                  std::uint32_t first_id) {
  const std::uint64_t particles = snapshot.gas.count() + snapshot.stars.count();
  const bool has_mass_block = header.mass_table[gas] == 0;
  RecordWriter writer(file);
  writer.write_header(header);
  writer.write_block("POS ", snapshot.gas.position, snapshot.stars.position);
  writer.write_block("VEL ", snapshot.gas.velocity, snapshot.stars.velocity);
  write_ids(writer, file, particles, first_id);
  if (has_mass_block) writer.write_block("MASS", masses(snapshot.gas), masses(snapshot.stars));
  writer.write_block("U   ", snapshot.gas.internal_energy);
  writer.write_block("RHO ", snapshot.gas.density);
  writer.write_block("HSML", snapshot.gas.smoothing_length);
  writer.write_block("HSMS", snapshot.stars.smoothing_length);
  writer.write_block("AGE ", snapshot.stars.age);
}

}  // namespace

void write_gadget2_part(UnfinishedFile& file, const GeneratedSnapshot& part, const GadgetSet& set) {
  Header header = make_header(part, set);
  header.mass_table[gas] = static_cast<double>(part.gas.mass);
  header.mass_table[stars] = static_cast<double>(part.stars.mass);
  write_blocks(file, part, header, set.first_id);
}

void write_gadget2(const std::filesystem::path& path, const GeneratedSnapshot& snapshot) {
  const std::uint64_t particles = snapshot.gas.count() + snapshot.stars.count();
  if (particles > most_particles) {
    throw DataError(path.string() + ": cannot be written: found " + std::to_string(particles) +
                    " particles, but a file of Gadget format 2 holds up to " +
                    std::to_string(most_particles) + "; make fewer");
  }
  UnfinishedFile file(path);
  const GadgetSet alone = {snapshot.gas.count(), snapshot.stars.count()};
  write_blocks(file, snapshot, make_header(snapshot, alone), alone.first_id);
  file.finish();
}

}  // namespace splotchcl
