#include "modules/module_file.h"

#include "cli/program.h"
#include "system/system.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

// Where somebody has left libraries by the names of all of our modules, and a picture that only
// OpenImageIO reads.
class ForeignFolder {
 public:
  ForeignFolder() {
    for (const char* const name : {"openimageio", "openmpi", "mpich"})
      plant(std::string("libsplotchcl_") + name + ".so");
    std::ofstream(folder_ / "a.ppm") << "P6\n1 1\n255\nabc";
    fs::create_symlink(test::program_path(), folder_ / "splotchcl");
  }

  void plant(const std::string& name) const {
    fs::copy_file(SPLOTCHCL_PLANTED_LIBRARY, folder_ / name, fs::copy_options::overwrite_existing);
  }
  ProgramResult run(const std::string& command) const { return run_in(folder_, command); }
  bool was_loaded() const { return fs::exists(folder_ / "LOADED"); }

 private:
  TemporaryFolder folder_;
};

std::string on_path(const std::string& command) {
  return "PATH=\"$(dirname \"$splotchcl\")\":$PATH; " + command;
}

TEST(Modules, AreNotThoseOfTheCurrentFolderWhenStartedThroughPath) {
  if (of_system::own_program() != "/proc/self/exe")
    GTEST_SKIP() << "the system tells of a program what its caller claims";
  const ForeignFolder folder;
  EXPECT_EQ(folder.run(on_path("splotchcl compare a.ppm a.ppm")).exit_code, 0);
  EXPECT_FALSE(folder.was_loaded());
}

TEST(Modules, OfMpiAreNotThoseOfTheCurrentFolder) {
  const ForeignFolder folder;
  for (const char* const started : {"OMPI_COMM_WORLD_SIZE=2", "PMI_SIZE=2", "SPLOTCHCL_MPI=mpich"})
    folder.run(on_path(std::string("timeout 60 env ") + started + " splotchcl render nothing"));
  EXPECT_FALSE(folder.was_loaded());
}

TEST(Modules, AreThoseOfTheProgramWhateverItIsCalled) {
  if (of_system::own_program() != "/proc/self/exe")
    GTEST_SKIP() << "the system tells of a program what its caller claims";
  const ForeignFolder folder;
  for (const char* const name : {"splotchcl", "./splotchcl", "nowhere/splotchcl", ""}) {
    EXPECT_EQ(folder
                  .run("bash -c '" + std::string("exec -a \"") + name +
                       "\" \"$splotchcl\" compare a.ppm a.ppm'")
                  .exit_code,
              0)
        << name;
  }
  EXPECT_EQ(folder.run("./splotchcl compare a.ppm a.ppm").exit_code, 0) << "a symbolic link";
  EXPECT_FALSE(folder.was_loaded());
}

TEST(Modules, AreNotLookedForWhereTheEnvironmentNamesFolders) {
  const ForeignFolder folder;
  EXPECT_EQ(folder.run("LD_LIBRARY_PATH=:/nowhere \"$splotchcl\" compare a.ppm a.ppm").exit_code,
            0);
  EXPECT_FALSE(folder.was_loaded());
}

TEST(ModuleFile, IsAnAbsolutePathBesideTheProgramAlsoWhereItIsMissing) {
  EXPECT_EQ(module_file("libsplotchcl_of_nobody.so"),
            (fs::read_symlink("/proc/self/exe").parent_path() / "libsplotchcl_of_nobody.so"));
}

TEST(ModuleFile, IsWhereAnInstallationHasIt) {
  EXPECT_THAT(module_places("/opt/splotch/lib"), ElementsAre("/opt/splotch/lib"));
  EXPECT_EQ(module_places("/opt/splotch/bin").size(), 2u);
  EXPECT_EQ(module_places("/opt/splotch/bin").back().string().rfind("/opt/splotch/lib", 0), 0u);
  EXPECT_EQ(module_places("/usr/lib/python3/dist-packages/splotchcl")
                .back()
                .string()
                .rfind("/usr/lib", 0),
            0u);
}

TEST(FileMappedAt, IsThatOfTheProgramAndOfALibrary) {
  static const int here = 0;
  EXPECT_EQ(file_mapped_at(&here), fs::read_symlink("/proc/self/exe"));
  const fs::path library = file_mapped_at(reinterpret_cast<const void*>(&std::getenv));
  EXPECT_TRUE(library.is_absolute());
}

// What the loader is told in an object, "" where it is told nothing: "/usr/lib:$ORIGIN".
std::string search_path(const TemporaryFolder& folder, const std::string& object) {
  const std::string dynamic = run_in(folder, "readelf -d '" + object + "'").out;
  for (const char* const kind : {"RUNPATH", "RPATH"}) {
    const std::size_t line = dynamic.find(std::string("(") + kind + ")");
    if (line == std::string::npos) continue;
    const std::size_t first = dynamic.find('[', line) + 1;
    return dynamic.substr(first, dynamic.find(']', first) - first);
  }
  return "";
}

TEST(SearchPaths, OfAllObjectsHaveAbsoluteEntriesOnly) {
  const TemporaryFolder folder;
  std::ifstream objects(SPLOTCHCL_OBJECTS);
  int count = 0;
  for (std::string object; std::getline(objects, object); ++count) {
    const std::string path = search_path(folder, object);
    if (path.empty()) continue;
    std::istringstream entries(path + ":");
    for (std::string entry; std::getline(entries, entry, ':');) {
      EXPECT_TRUE(entry.rfind('/', 0) == 0 || entry.rfind("$ORIGIN", 0) == 0)
          << object << " has '" << entry << "' in " << path;
    }
  }
  EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace splotchcl::test
