// What --explain says of a frame before it is drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

class Explanation : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    ASSERT_EQ(splotchcl_in(folder_, "generate universe -o u --particles 40000").exit_code, 0);
  }
  TemporaryFolder folder_;
};

// The first number after the word.
double number_after(const std::string& word, const std::string& text) {
  const std::size_t place = text.find(word);
  return place == std::string::npos ? -1 : std::stod(text.substr(place + word.size()));
}

TEST_F(Explanation, TellsTheMemoryThatTheDeviceWillTake) {
  for (const std::string scene :
       {"u --set image.size=[80,60]", "u --set image.size=[900,700]",
        "u --set image.size=[300,200] --set component.gas.absorption=0.5",
        "u --set image.size=[30,20] --set component.gas.absorption=0.5 --tolerance 0"}) {
    SCOPED_TRACE(scene);
    const ProgramResult result =
        splotchcl_in(folder_, "render " + scene + " --explain -o a.png --stats s.json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto stats = nlohmann::json::parse(read_text(folder_ / "s.json"));
    const double bytes = stats["device_bytes"];
    EXPECT_NEAR(number_after("# memory: ", result.out), bytes / 1e6, 0.1 * bytes / 1e6);
  }
}

TEST_F(Explanation, EstimatesTheTimeAndSaysByWhat) {
  const std::string small = splotchcl_in(folder_, "render u --explain --every 10").out;
  const std::string large = splotchcl_in(folder_, "render u --explain").out;
  EXPECT_THAT(large, HasSubstr("an estimate"));
  EXPECT_THAT(large, HasSubstr("measured on two cores"));
  EXPECT_GT(number_after("# time: about ", large), number_after("# time: about ", small));
  EXPECT_GT(number_after("# time: about ", small), 0);
}

TEST_F(Explanation, CountsEveryViewOfAPicture) {
  const std::string pair = splotchcl_in(folder_, "render u --explain --set stereo.angle=2").out;
  EXPECT_THAT(pair, HasSubstr("(2 drawings, "));
}

TEST_F(Explanation, NeedsNoDevice) {
  const ProgramResult result =
      run_in(folder_,
             "mkdir none; OCL_ICD_VENDORS=$PWD/none OPENCL_VENDOR_PATH=$PWD/none "
             "\"$splotchcl\" render u --explain > scene.toml && cat scene.toml");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("no estimate without an OpenCL device"));
  EXPECT_THAT(result.out, HasSubstr("[[component]]"));
}

TEST_F(Explanation, OfAFilmCountsItsFrames) {
  const ProgramResult result =
      splotchcl_in(folder_,
                   "movie u --explain --max-particles 1000 --set movie.frames=40 "
                   "--set path.orbit.degrees=90 --frames 0:30");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("# film: 30 frames"));
  EXPECT_THAT(result.out, HasSubstr("(30 drawings, "));
  EXPECT_THAT(result.out, HasSubstr("max_particles = 1000"));
  EXPECT_EQ(folder_.count_files(), 1U);  // the snapshot
}

}  // namespace
}  // namespace splotchcl::test
