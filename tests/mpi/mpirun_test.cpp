// The program started by mpirun: the bits of one process, and one line where a process fails.
#include <nlohmann/json.hpp>

#include "mpi/under_mpi.h"
#include "spread/component_texts.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

struct SmallScene {
  std::string name, text;
};

const std::string gas = test::gas_component, stars = test::stars_component;

std::vector<SmallScene> small_scenes() {
  const std::string head = "snapshot = \"u\"\n[image]\nsize = [160, 80]\n";
  const std::string both = gas + "absorption = 0.2\n" + stars;
  return {
      {"emission", head + gas + "absorption = 0\n"},
      {"proportional", head + gas},
      {"ordered", head + both},
      {"by_a_field", head + "[sort]\nby = \"mass\"\n" + both},
      {"panorama", head +
                       "[camera]\nprojection = \"equirectangular\"\n"
                       "position = [-90000, 25000, 25000]\nlook_at = [25000, 25000, 25000]\n" +
                       both},
      {"within",
       head + "[camera]\nposition = [24000, 25000, 25000]\nlook_at = [25000, 25000, 25000]\n" +
           both},
      {"most_exact", "tolerance = 0\n" + head + both},
      {"two_eyes", head + "[stereo]\nlayout = \"side_by_side\"\n" + both},
  };
}

class MpiRun : public UnderMpi {
 protected:
  void SetUp() override {
    UnderMpi::SetUp();
    if (IsSkipped()) return;
    std::filesystem::copy(made_once("generate universe --particles 30000"), *folder_ / "u");
  }
};

INSTANTIATE_TEST_SUITE_P(Mpis, MpiRun, all_mpis(), name_of_mpi);

TEST_P(MpiRun, DrawsTheBitsOfOneProcess) {
  int processes = 2;
  for (const SmallScene& scene : small_scenes()) {
    write(scene.name + ".toml", scene.text);
    const std::string command = "\"$splotchcl\" render " + scene.name + ".toml -o ";
    const ProgramResult one = run(command + "one.exr");
    ASSERT_EQ(one.exit_code, 0) << scene.name << ": " << one.err;
    const ProgramResult many = run(mpirun(processes) + command + "many.exr --stats stats.json");
    ASSERT_EQ(many.exit_code, 0) << scene.name << ": " << many.err;
    EXPECT_EQ(read_text(*folder_ / "many.exr"), read_text(*folder_ / "one.exr")) << scene.name;
    const auto stats = nlohmann::json::parse(read_text(*folder_ / "stats.json"));
    EXPECT_EQ(stats["processes"]["number"], processes) << scene.name;
    EXPECT_EQ(stats["processes"]["ranks"].size(), static_cast<std::size_t>(processes));
    processes = processes == 4 ? 2 : processes + 1;
  }
}

// Each process looks at its part of what is decided from all particles.
TEST_P(MpiRun, DecidesWhatOneProcessDoesForASnapshotAlone) {
  const ProgramResult one = run("\"$splotchcl\" render u -o one.exr --size 160x80");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const ProgramResult many = run(mpirun(3) + "\"$splotchcl\" render u -o many.exr --size 160x80");
  ASSERT_EQ(many.exit_code, 0) << many.err;
  EXPECT_EQ(read_text(*folder_ / "many.exr"), read_text(*folder_ / "one.exr"));
}

TEST_P(MpiRun, MakesTheFramesOfOneProcess) {
  write("film.toml", small_scenes()[2].text + "[path.orbit]\ndegrees = 20\n[movie]\nframes = 3\n");
  ASSERT_EQ(run("\"$splotchcl\" movie film.toml -o one_%d.png").exit_code, 0);
  const ProgramResult many = run(mpirun(2) + "\"$splotchcl\" movie film.toml -o many_%d.png");
  ASSERT_EQ(many.exit_code, 0) << many.err;
  for (const std::string frame : {"0", "1", "2"}) {
    EXPECT_EQ(read_text(*folder_ / ("many_" + frame + ".png")),
              read_text(*folder_ / ("one_" + frame + ".png")));
  }
}

TEST_P(MpiRun, TellsOnceThatASceneIsMissing) {
  const ProgramResult result = run(mpirun(3) + "\"$splotchcl\" render no.toml -o a.png");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(own_line(result.err), HasSubstr("no.toml"));
}

TEST_P(MpiRun, NamesTheProcessForWhichAFileIsMissing) {
  write("scene.toml", small_scenes()[0].text);
  write("in_its_folder",
        "#!/bin/sh\nrank=${OMPI_COMM_WORLD_RANK:-$PMI_RANK}\nmkdir -p $rank; cd $rank\n"
        "ln -sf ../scene.toml .\n[ $rank = 1 ] || ln -sf ../u .\n"
        "exec \"$splotchcl\" render scene.toml -o ../a.png\n");
  const ProgramResult result = run("chmod +x in_its_folder; " + mpirun(3) + "./in_its_folder");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(own_line(result.err), HasSubstr("process 1 on "));
  EXPECT_FALSE(std::filesystem::exists(*folder_ / "a.png"));
}

// One process fails while the others look at particles with it.
TEST_P(MpiRun, NamesTheProcessForWhichASnapshotIsMissing) {
  write("in_its_folder",
        "#!/bin/sh\nrank=${OMPI_COMM_WORLD_RANK:-$PMI_RANK}\nmkdir -p $rank; cd $rank\n"
        "[ $rank = 1 ] || ln -sf ../u .\nexec \"$splotchcl\" render u -o ../a.png\n");
  const ProgramResult result = run("chmod +x in_its_folder; " + mpirun(3) + "./in_its_folder");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_NE(result.exit_code, 124) << "it had to be stopped";
  EXPECT_THAT(own_line(result.err), HasSubstr("process 1 on "));
}

// Each host has a disk of its own, and one an older snapshot.
TEST_P(MpiRun, RefusesSnapshotsOfOneNameThatDiffer) {
  ASSERT_EQ(run("\"$splotchcl\" generate universe -o v --particles 30000 --seed 7").exit_code, 0);
  write("scene.toml", small_scenes()[0].text);
  write("in_its_folder",
        "#!/bin/sh\nrank=${OMPI_COMM_WORLD_RANK:-$PMI_RANK}\nmkdir -p $rank; cd $rank\n"
        "ln -sf ../scene.toml .\n[ $rank = 1 ] && ln -sf ../v u || ln -sf ../u .\n"
        "exec \"$splotchcl\" $@\n");
  run("chmod +x in_its_folder");
  for (const char* const command :
       {"render scene.toml -o ../a.png",
        "movie scene.toml --set movie.frames=2 --set path.orbit.degrees=90 -o ../f_%04d.png"}) {
    const ProgramResult result = run(mpirun(2) + "./in_its_folder " + command);
    EXPECT_NE(result.exit_code, 0) << command;
    EXPECT_NE(result.exit_code, 124) << "it had to be stopped";
    EXPECT_THAT(own_line(result.err), HasSubstr("give all processes the same files")) << command;
    EXPECT_FALSE(std::filesystem::exists(*folder_ / "a.png"));
    EXPECT_FALSE(std::filesystem::exists(*folder_ / "f_0000.png"));
  }
}

TEST_P(MpiRun, EndsWhereThePictureCannotBeWritten) {
  write("scene.toml", small_scenes()[0].text);
  const ProgramResult result = run("ln -s /dev/full full.png; " + mpirun(2) +
                                   "\"$splotchcl\" render scene.toml -o full.png");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(own_line(result.err), HasSubstr("full.png: cannot be written"));
}

TEST_P(MpiRun, EndsWhereAProcessIsKilled) {
  write("scene.toml", small_scenes()[2].text);
  write_one_is_killed("\"$splotchcl\" render scene.toml -o a.png");
  const ProgramResult result = run(mpirun(3) + "./one_is_killed");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_NE(result.exit_code, 124) << "it had to be stopped";
  EXPECT_FALSE(std::filesystem::exists(*folder_ / "a.png"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_->path()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST_P(MpiRun, LeavesProcessesAloneThatAreToldSo) {
  write("scene.toml", small_scenes()[0].text);
  const ProgramResult result =
      run("SPLOTCHCL_MPI=none " + mpirun(2) + "sh -c '\"$splotchcl\" render scene.toml -o $$.png'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto entries = std::filesystem::directory_iterator(folder_->path());
  EXPECT_EQ(std::count_if(begin(entries), end(entries),
                          [](const auto& entry) { return entry.path().extension() == ".png"; }),
            2);
}

TEST_P(MpiRun, RefusesTheReference) {
  write("scene.toml", small_scenes()[0].text);
  const ProgramResult result =
      run(mpirun(2) + "\"$splotchcl\" render scene.toml --reference -o a.png");
  EXPECT_THAT(own_line(result.err), HasSubstr("--reference: found 2 processes, expected one"));
}

}  // namespace
}  // namespace splotchcl::test
