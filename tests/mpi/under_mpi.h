#pragma once

#include "cli/program.h"
#include "testing.h"

namespace splotchcl::test {

struct Mpi {
  std::string name;  // of the module
  std::string run;   // with the number of processes behind it
};

inline std::ostream& operator<<(std::ostream& out, const Mpi& mpi) {
  return out << mpi.name;
}

class UnderMpi : public ::testing::TestWithParam<Mpi> {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    const std::filesystem::path module =
        test::program_path().parent_path() / ("libsplotchcl_" + GetParam().name + ".so");
    if (!std::filesystem::exists(module)) GTEST_SKIP() << "built without " << GetParam().name;
    folder_ = std::make_unique<TemporaryFolder>();
    if (run("command -v " + program()).exit_code != 0)
      GTEST_SKIP() << "no " << program() << " here; scripts/setup installs it";
  }

  std::string program() const { return GetParam().run.substr(0, GetParam().run.find(' ')); }
  // A script `one_is_killed` for mpirun. Rank 1 is stopped while it compiles, before any rank can
  // have what it needs of it, and dies.
  void write_one_is_killed(const std::string& command) const {
    write("one_is_killed",
          "#!/bin/sh\nexport SPLOTCHCL_CACHE=\nrank=${OMPI_COMM_WORLD_RANK:-$PMI_RANK}\n"
          "if [ $rank = 1 ]; then (sleep 0.3; kill -STOP $$; sleep 0.6; kill -KILL $$) & fi\n"
          "exec " +
              command + "\n");
    std::filesystem::permissions(*folder_ / "one_is_killed", std::filesystem::perms::owner_all);
  }
  // Open MPI has to be told that containers and test machines have one user.
  ProgramResult run(const std::string& command) const {
    return run_in(*folder_,
                  "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; " + command);
  }
  std::string mpirun(int processes) const {
    return "timeout 300 " + GetParam().run + " " + std::to_string(processes) + " ";
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(*folder_ / name) << text;
  }
  // What a program itself has told, in one line: MPIs tell of processes that have failed as well.
  static std::string own_line(const std::string& text, const std::string& name = "splotchcl") {
    std::vector<std::string> lines;
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);) {
      if (line.rfind(name + ": ", 0) == 0) lines.push_back(line);
    }
    EXPECT_EQ(lines.size(), 1u) << text;
    return lines.empty() ? "" : lines.front();
  }

  std::unique_ptr<TemporaryFolder> folder_;
};

// Open MPI has to be told that there may be more processes than cores.
inline auto all_mpis() {
  return ::testing::Values(Mpi{"openmpi", "mpirun.openmpi --oversubscribe -n"},
                           Mpi{"mpich", "mpirun.mpich -n"});
}
inline std::string name_of_mpi(const ::testing::TestParamInfo<Mpi>& info) {
  return info.param.name;
}

}  // namespace splotchcl::test
