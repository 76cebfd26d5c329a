// A simulation under mpirun that draws itself, each rank with its own particles: the bits of one
// process, and one line where a rank fails.
#include "mpi/under_mpi.h"
#include "spread/component_texts.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

const std::string head = "[image]\nsize = [120, 90]\n";
const std::string camera = "[camera]\nposition = [0, -4, 1]\nlook_at = [0, 0, 0]\n";
const std::string gas_text = test::gas_component, stars_text = test::stars_component;

class SpreadRun : public UnderMpi {
 protected:
  ProgramResult run_simulation(const std::string& start, const std::string& arguments) const {
    const std::string folder = test::program_path().parent_path().string();
    return run("export POCL_WORK_GROUP_SPECIALIZATION=0 LD_LIBRARY_PATH='" + folder +
               "' simulation='" + folder + "/spread_program_" + GetParam().name + "'; " + start +
               arguments);
  }
  ProgramResult simulate(int ranks, const std::string& arguments) const {
    return run_simulation(mpirun(ranks), "\"$simulation\" " + arguments);
  }
  bool has_pictures() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_->path())) {
      if (entry.path().extension() == ".floats") return true;
    }
    return false;
  }
};

INSTANTIATE_TEST_SUITE_P(Mpis, SpreadRun, all_mpis(), name_of_mpi);

// Of three ranks one has no particles.
TEST_P(SpreadRun, DrawsTheBitsOfOneProcess) {
  const std::vector<std::string> scenes = {
      head + gas_text + "absorption = 0\n",
      head + camera + gas_text,
      head + camera + gas_text + "absorption = 0.2\n" + stars_text,
      head + camera + gas_text + "select = { where = \"internal_energy > 300\" }\n" + stars_text,
  };
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    write("scene.toml", scenes[s]);
    for (int ranks = 1; ranks <= 3; ++ranks) {
      const ProgramResult result = simulate(ranks, "scene.toml " + std::to_string(ranks));
      ASSERT_EQ(result.exit_code, 0) << scenes[s] << result.err;
    }
    const std::string one = read_text(*folder_ / "1");
    EXPECT_EQ(one.size(), std::size_t{4 * 4 * 120 * 90});
    EXPECT_TRUE(read_text(*folder_ / "2") == one) << scenes[s];
    EXPECT_TRUE(read_text(*folder_ / "3") == one) << scenes[s];
  }
}

TEST_P(SpreadRun, TellsOnceWhatAllRanksDoWrong) {
  write("scene.toml", head + camera + gas_text + "intensity = { field = \"entropy\" }\n");
  const ProgramResult result = simulate(3, "scene.toml a.floats");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(own_line(result.err, "simulation"), HasSubstr("entropy"));
  EXPECT_FALSE(has_pictures());
}

TEST_P(SpreadRun, NamesTheRankThatHasNoDevice) {
  write("scene.toml", head + camera + gas_text);
  const ProgramResult result = simulate(3, "scene.toml a.floats 1000 none_of_this_name");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_NE(result.exit_code, 124) << "it had to be stopped";
  EXPECT_THAT(own_line(result.err, "simulation"), HasSubstr("process 1 on "));
  EXPECT_FALSE(has_pictures());
}

TEST_P(SpreadRun, EndsWhereARankIsKilled) {
  write("scene.toml", head + camera + gas_text + "absorption = 0.2\n" + stars_text);
  write_one_is_killed("\"$simulation\" scene.toml a.floats");
  const ProgramResult result = run_simulation(mpirun(3), "./one_is_killed");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_NE(result.exit_code, 124) << "it had to be stopped";
  EXPECT_FALSE(has_pictures());
}

}  // namespace
}  // namespace splotchcl::test
