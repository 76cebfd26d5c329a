// Data larger than memory, in the long tests alone: 200 million particles in 16 files within 1.5
// GB, and a column of more than 2 GiB.
#include <hdf5.h>

#include "cli/program.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

#define SKIP_UNLESS_LONG() \
  if (!test::long_tests()) GTEST_SKIP() << "gigabytes of particles: SPLOTCHCL_LONG_TESTS=1"

constexpr double box = 100;
constexpr std::uint64_t at_a_time = 1 << 20;

// Numbers in [0, 1).
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  float next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<float>(state_ >> 40) * 0x1p-24f;
  }

 private:
  std::uint64_t state_;
};

// Particles [first, first + count) of `all`, in the order of x.
std::vector<float> positions(std::uint64_t first, std::uint64_t count, std::uint64_t all) {
  Numbers numbers(first);
  std::vector<float> values;
  values.reserve(3 * count);
  for (std::uint64_t i = first; i < first + count; ++i) {
    values.push_back(static_cast<float>(box * static_cast<double>(i) / static_cast<double>(all)));
    values.push_back(static_cast<float>(box) * numbers.next());
    values.push_back(static_cast<float>(box) * numbers.next());
  }
  return values;
}

// A Gadget file of format 2, written block by block.
class GadgetFile {
 public:
  GadgetFile(const std::filesystem::path& path, std::uint32_t count, std::uint32_t all,
             std::uint32_t files)
      : file_(path, std::ios::binary) {
    std::array<char, 256> header{};
    const auto put = [&header](std::size_t at, const auto& value) {
      std::memcpy(header.data() + at, &value, sizeof value);
    };
    put(0, count);
    put(24, 1.0);  // the mass of each
    put(96, all);
    put(124, files);
    put(128, box);
    begin("HEAD", 256);
    file_.write(header.data(), 256);
    end(256);
  }
  void begin(const char* label, std::uint32_t bytes) {
    number(8);
    file_.write(label, 4);
    number(bytes + 8);
    number(8);
    number(bytes);
  }
  void end(std::uint32_t bytes) { number(bytes); }
  void write(const std::vector<float>& values) {
    file_.write(reinterpret_cast<const char*>(values.data()),
                static_cast<std::streamsize>(values.size() * sizeof(float)));
  }

 private:
  void number(std::uint32_t value) { file_.write(reinterpret_cast<const char*>(&value), 4); }
  std::ofstream file_;
};

void write_part(const std::filesystem::path& path, std::uint64_t first, std::uint32_t count,
                std::uint32_t all, std::uint32_t files) {
  GadgetFile file(path, count, all, files);
  file.begin("POS ", 12 * count);
  for (std::uint64_t i = 0; i < count; i += at_a_time)
    file.write(positions(first + i, std::min<std::uint64_t>(at_a_time, count - i), all));
  file.end(12 * count);
  Numbers numbers(first + 1);
  for (const char* const label : {"U   ", "HSML"}) {
    const bool is_length = std::string(label) == "HSML";
    file.begin(label, 4 * count);
    std::vector<float> values(count);
    for (float& value : values)
      value = is_length ? 0.1f + 0.2f * numbers.next() : 1 + 99 * numbers.next();
    file.write(values);
    file.end(4 * count);
  }
}

void write_set(const std::filesystem::path& base, std::uint32_t all, std::uint32_t files) {
  const std::uint32_t each = all / files;
  for (std::uint32_t f = 0; f < files; ++f) {
    write_part(base.string() + "." + std::to_string(f), std::uint64_t{f} * each, each, all, files);
  }
}

void write_scene(const std::filesystem::path& path, const std::string& snapshot,
                 const std::string& of_component) {
  std::ofstream(path) << "snapshot = \"" << snapshot << R"("
[image]
size = [800, 600]
[camera]
position = [-60, -120, 110]
look_at = [50, 50, 50]
sky = [0, 0, 1]
field_of_view = 45
[[component]]
name = "gas"
types = "gas"
weight = "constant"
reference_column = 1e4
palette = "temperature"
)" << of_component;
}

class LargeData : public ::testing::Test {
 protected:
  ProgramResult within(const std::string& bytes, const std::string& arguments) const {
    return run_in(folder_, "'" + (test::source_folder() / "tests/cli/within_memory").string() +
                               "' " + bytes + " \"$splotchcl\" " + arguments);
  }
  TemporaryFolder folder_;
};

// As many bytes as the process and the pages of its files may take together.
constexpr const char* little = "1610612736";

TEST_F(LargeData, IsDrawnInBothKindsOfPlanWithinALittleMemory) {
  SKIP_UNLESS_LONG();
  SKIP_WITHOUT_DEVICE();
  write_set(folder_ / "large", 200000000, 16);
  const std::string color = "color = { field = \"U\", min = 0, max = 100 }\n";
  write_scene(folder_ / "sums.toml", "large.0", color);
  write_scene(folder_ / "ordered.toml", "large.0", color + "gray_absorption = 0.3\n");
  for (const std::string plan : {"sums", "ordered"}) {
    const ProgramResult result =
        within(little, "render " + plan + ".toml -o " + plan + "_within.exr --stats within.json");
    if (result.exit_code == 77) GTEST_SKIP() << result.err;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const ProgramResult whole =
        splotchcl_in(folder_, "render " + plan + ".toml -o " + plan + ".exr --memory 12GB");
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_EQ(read_text(folder_ / (plan + ".exr")), read_text(folder_ / (plan + "_within.exr")));
  }
}

// Positions alone: 3 floats for each.
void write_large_column(const std::filesystem::path& path, std::uint64_t count) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t group = H5Gcreate(file, "PartType0", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const std::array<hsize_t, 2> size = {count, 3};
  const hid_t space = H5Screate_simple(2, size.data(), nullptr);
  const hid_t dataset =
      H5Dcreate(group, "Coordinates", H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  for (std::uint64_t first = 0; first < count; first += at_a_time) {
    const std::uint64_t part = std::min(at_a_time, count - first);
    const std::array<hsize_t, 2> start = {first, 0}, extent = {part, 3};
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
    const hid_t memory = H5Screate_simple(2, extent.data(), nullptr);
    const std::vector<float> values = positions(first, part, count);
    EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_FLOAT, memory, space, H5P_DEFAULT, values.data()), 0);
    H5Sclose(memory);
  }
  H5Dclose(dataset);
  H5Sclose(space);
  H5Gclose(group);
  const hid_t header = H5Gcreate(file, "Header", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const auto attribute = [header](const char* name, hid_t type, const auto& values) {
    const hsize_t length = values.size();
    const hid_t extent = H5Screate_simple(1, &length, nullptr);
    const hid_t made = H5Acreate(header, name, type, extent, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(made, type, values.data()), 0);
    H5Aclose(made);
    H5Sclose(extent);
  };
  const std::array<std::uint32_t, 6> counts = {static_cast<std::uint32_t>(count)};
  attribute("NumPart_ThisFile", H5T_NATIVE_UINT32, counts);
  attribute("NumPart_Total", H5T_NATIVE_UINT32, counts);
  attribute("MassTable", H5T_NATIVE_DOUBLE, std::array<double, 6>{1});
  attribute("NumFilesPerSnapshot", H5T_NATIVE_UINT32, std::array<std::uint32_t, 1>{1});
  attribute("BoxSize", H5T_NATIVE_DOUBLE, std::array<double, 1>{box});
  attribute("Time", H5T_NATIVE_DOUBLE, std::array<double, 1>{1});
  H5Gclose(header);
  H5Fclose(file);
}

TEST_F(LargeData, MayBeAColumnLargerThanTwoGibibytes) {
  SKIP_UNLESS_LONG();
  SKIP_WITHOUT_DEVICE();
  constexpr std::uint64_t count = 185000000;
  write_large_column(folder_ / "column.hdf5", count);
  ASSERT_GT(std::filesystem::file_size(folder_ / "column.hdf5"), std::uint64_t{2} << 30);
  write_scene(folder_ / "scene.toml", "column.hdf5", "size.fixed = 0.2\n");
  const ProgramResult result =
      within(little, "render scene.toml -o picture.exr --stats stats.json");
  if (result.exit_code == 77) GTEST_SKIP() << result.err;
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_text(folder_ / "stats.json"), HasSubstr("\"total\": 185000000"));
}

}  // namespace
}  // namespace splotchcl::test
