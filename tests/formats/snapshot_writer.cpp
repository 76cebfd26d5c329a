#include "formats/snapshot_writer.h"

#include "testing.h"

namespace splotchcl::test {
namespace {

class ByteWriter {
 public:
  explicit ByteWriter(bool is_swapped) : is_swapped_(is_swapped) {}

  template <typename T>
  void number(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (is_swapped_) std::reverse(bytes, bytes + sizeof(T));
    bytes_.append(bytes, sizeof(T));
  }
  void text(const std::string& text) { bytes_ += text; }
  void value(double value, ValueKind kind) {
    if (kind == ValueKind::float32) number(static_cast<float>(value));
    if (kind == ValueKind::float64) number(value);
    if (kind == ValueKind::uint32) number(static_cast<std::uint32_t>(value));
    if (kind == ValueKind::uint64) number(static_cast<std::uint64_t>(value));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  bool is_swapped_;
};

std::string header_bytes(const TestSnapshot& snapshot, bool is_swapped) {
  ByteWriter out(is_swapped);
  for (const std::uint32_t count : snapshot.counts)
    out.number(count);
  for (const double mass : snapshot.table_masses)
    out.number(mass);
  out.number(snapshot.time);
  out.number(snapshot.redshift);
  out.number(std::uint32_t{0});  // star formation
  out.number(std::uint32_t{0});  // feedback
  for (const auto count : snapshot.total_counts)
    out.number(static_cast<std::uint32_t>(count));
  out.number(snapshot.flag_cooling);
  out.number(snapshot.files);
  out.number(snapshot.box_size);
  out.number(snapshot.omega_matter);
  out.number(0.7);
  out.number(snapshot.hubble_parameter);
  out.number(std::uint32_t{0});  // stellar age
  out.number(std::uint32_t{0});  // metals
  for (std::size_t type = 0; type < 6; ++type) {
    out.number(snapshot.high_words.empty()
                   ? static_cast<std::uint32_t>(snapshot.total_counts[type] >> 32)
                   : snapshot.high_words[type]);
  }
  std::string bytes = out.bytes();
  bytes.resize(256, '\0');
  return bytes;
}

std::string block_bytes(const TestBlock& block, bool is_swapped) {
  ByteWriter out(is_swapped);
  for (const auto& of_type : block.values) {
    for (const double value : of_type)
      out.value(value, block.kind);
  }
  return out.bytes();
}

}  // namespace

TestBlock& TestSnapshot::block(const std::string& label) {
  for (TestBlock& block : blocks) {
    if (block.label == label) return block;
  }
  throw std::logic_error("no block " + label);
}

void TestSnapshot::remove(const std::string& label) {
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(),
                              [&](const TestBlock& block) { return block.label == label; }),
               blocks.end());
}

void add_block(TestSnapshot& snapshot, const std::string& label, unsigned types,
               int values_per_particle) {
  TestBlock block = {label, types, values_per_particle, ValueKind::float32, {}};
  block.values.resize(6);
  // Quarters are exact in single precision, and each block begins at another number.
  double next = 1 + 1000.0 * static_cast<double>(snapshot.blocks.size());
  for (std::size_t type = 0; type < 6; ++type) {
    if ((types >> type & 1U) == 0) continue;
    const std::size_t size = snapshot.counts[type] * static_cast<std::size_t>(values_per_particle);
    for (std::size_t i = 0; i < size; ++i)
      block.values[type].push_back(next += 0.25);
  }
  snapshot.blocks.push_back(std::move(block));
}

TestSnapshot small_snapshot() {
  TestSnapshot snapshot;
  snapshot.counts = {37, 20, 0, 0, 11, 0};
  snapshot.total_counts = {37, 20, 0, 0, 11, 0};
  snapshot.table_masses[1] = 2.625;
  constexpr unsigned gas = 1U, halo = 2U, stars = 16U, all = gas | halo | stars;
  add_block(snapshot, "POS", all, 3);
  add_block(snapshot, "VEL", all, 3);
  add_block(snapshot, "ID", all, 1);
  snapshot.set_kind("ID", ValueKind::uint32);
  add_block(snapshot, "MASS", gas | stars, 1);
  add_block(snapshot, "U", gas, 1);
  add_block(snapshot, "RHO", gas, 1);
  add_block(snapshot, "HSML", gas, 1);
  add_block(snapshot, "POT", all, 1);
  add_block(snapshot, "ACCE", all, 3);
  add_block(snapshot, "HSMS", stars, 1);
  add_block(snapshot, "AGE", stars, 1);
  for (auto& of_type : snapshot.block("ID").values) {
    for (double& id : of_type)
      id = static_cast<double>(static_cast<std::uint64_t>(4 * id));
  }
  return snapshot;
}

std::vector<TestSnapshot> split(const TestSnapshot& snapshot, std::uint32_t files) {
  std::vector<TestSnapshot> members;
  for (std::uint32_t member = 0; member < files; ++member) {
    TestSnapshot part = snapshot;
    part.files = files;
    for (std::size_t type = 0; type < 6; ++type) {
      const std::size_t count = snapshot.counts[type];
      const std::size_t first = count * member / files;
      const std::size_t last = count * (member + 1) / files;
      part.counts[type] = static_cast<std::uint32_t>(last - first);
      for (TestBlock& block : part.blocks) {
        auto& values = block.values[type];
        if (values.empty()) continue;
        const auto width = static_cast<std::size_t>(block.values_per_particle);
        values = std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first * width),
                                     values.begin() + static_cast<std::ptrdiff_t>(last * width));
      }
    }
    members.push_back(std::move(part));
  }
  return members;
}

BinaryFile to_gadget(const TestSnapshot& snapshot, int format, bool is_swapped) {
  ByteWriter out(is_swapped);
  BinaryFile file;
  const auto write_block = [&](std::string label, const std::string& bytes) {
    const auto length = static_cast<std::uint32_t>(bytes.size());
    if (format == 2) {
      label.resize(4, ' ');
      out.number(std::uint32_t{8});
      out.text(label);
      out.number(length + 8);
      out.number(std::uint32_t{8});
    }
    out.number(length);
    out.text(bytes);
    out.number(length);
    file.block_ends.push_back(out.bytes().size());
  };
  write_block("HEAD", header_bytes(snapshot, is_swapped));
  for (const TestBlock& block : snapshot.blocks) {
    write_block(block.label, block_bytes(block, is_swapped));
  }
  file.bytes = out.bytes();
  return file;
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  // Some file systems write a file that is emptied and filled again to disk at once.
  std::filesystem::remove(path);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void write_gadget(const std::filesystem::path& path, const TestSnapshot& snapshot, int format,
                  bool is_swapped) {
  write_bytes(path, to_gadget(snapshot, format, is_swapped).bytes);
}

void write_gadget_set(const std::filesystem::path& base, const std::vector<TestSnapshot>& members,
                      int format) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    write_gadget(base.string() + "." + std::to_string(i), members[i], format);
  }
}

}  // namespace splotchcl::test
