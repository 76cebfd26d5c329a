// The specialization alone writes the #defines that reach a kernel, and knows the sizes that
// follow from them.
#include "device/frame/specialization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "device/opencl/launch.h"
#include "device/stages.h"
#include "matches.h"
#include "paths.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  return files;
}

// The first group of every match.
std::set<std::string> names_in(const std::string& text, const std::string& pattern) {
  std::set<std::string> names;
  for (const Match& match : matches_of(text, pattern))
    names.insert(match[1]);
  return names;
}

const fs::path specialization = source_folder() / "src/device/frame/specialization.cpp";

std::string kernel_texts() {
  std::string text;
  for (const fs::path& file : files_below(source_folder() / "kernels"))
    text += text_of(file);
  return text;
}

// A regular expression would take seconds.
std::set<std::string> words_of(const std::string& text) {
  const auto is_of_word = [](char letter) {
    return letter == '_' || std::isalnum(static_cast<unsigned char>(letter)) != 0;
  };
  std::set<std::string> words;
  for (auto begin = text.begin(); begin != text.end();) {
    begin = std::find_if(begin, text.end(), is_of_word);
    const auto end = std::find_if_not(begin, text.end(), is_of_word);
    if (begin != end) words.emplace(begin, end);
    begin = end;
  }
  return words;
}

std::set<std::string> written_macros() {
  return names_in(text_of(specialization), R"re(define(?:_if)?\([^"]*"([A-Z0-9_]+))re");
}

// What compilers have beyond the language.
std::set<std::string> macros_of_options() {
  return names_in(text_of(source_folder() / "src/device/opencl/program_text.cpp"),
                  R"re("-D(HAS_\w+)")re");
}

TEST(Defines, AreWrittenByTheSpecializationAlone) {
  for (const fs::path& file : files_below(source_folder() / "src")) {
    if (file == specialization) continue;
    EXPECT_EQ(text_of(file).find("\"#define"), std::string::npos) << file;
  }
}

TEST(Defines, ThatKernelsAskForAreWrittenOrTheirOwn) {
  const std::string kernels = kernel_texts();
  const std::set<std::string> written = written_macros();
  const std::set<std::string> own = names_in(kernels, R"(#define (\w+))");
  const std::set<std::string> of_options = macros_of_options();
  EXPECT_GE(of_options.size(), 2u);
  for (const std::string& asked : names_in(kernels, R"((?:#ifdef |#ifndef |defined\()(\w+))")) {
    const bool of_the_language = asked.rfind("__", 0) == 0 || asked.rfind("cl_khr_", 0) == 0;
    EXPECT_TRUE(of_the_language || written.count(asked) || own.count(asked) ||
                of_options.count(asked))
        << asked;
  }
}

TEST(Defines, ThatAreWrittenAreReadByAKernel) {
  const std::set<std::string> words = words_of(kernel_texts());
  const std::set<std::string> written = written_macros();
  EXPECT_GT(written.size(), 15u);
  for (const std::string& macro : written)
    EXPECT_EQ(words.count(macro), 1u) << macro;
}

class Sizes : public StageTest {
 protected:
  // What the device takes the structure for, in the variant of this program.
  static std::size_t size_on_device(ProgramSource source, const std::string& structure) {
    source.more =
        "__kernel void size(__global uint* result) { *result = sizeof(" + structure + "); }";
    const auto result = device().pool.get<cl_uint>(1, "size");
    Launch(device(), "test", device().programs.get(source).create_kernel("size"))
        .arg(result)
        .run_items(1);
    return device().pool.download(result, 1).front();
  }

  static void expect_equal_sizes(const Frame& frame) {
    const FramePlan plan = make_plan(frame);
    const Specialization variant(frame, plan, device().traits);
    EXPECT_EQ(size_on_device(variant.bin(), "Splat"), variant.splat_bytes());
    EXPECT_EQ(size_on_device(variant.bin(), "TileSplat"), variant.tile_splat_bytes());
    if (variant.is_extended()) {
      EXPECT_EQ(size_on_device(variant.bin(), "ExtendedSplat"), variant.extended_splat_bytes());
    }
  }

  static Frame small_frame() {
    return frame_of(20, 10, {component_of({{0, 0, 1, 1, 1}}, two_colors())});
  }
};

TEST_F(Sizes, OfSplatsAreTheKernelsInEveryVariant) {
  Frame frame = small_frame();
  expect_equal_sizes(frame);
  frame.components.front().absorption = {Absorption::Kind::gray, 1};
  expect_equal_sizes(frame);
  frame.components.front().particles.color_vector = Column::owning({1, 1, 1});
  expect_equal_sizes(frame);
  frame.tolerance = 0;
  expect_equal_sizes(frame);
  frame.projection = Projection::equirectangular;
  expect_equal_sizes(frame);
  frame.components.front().absorption = {Absorption::Kind::none, 0};
  expect_equal_sizes(frame);
}

TEST_F(Sizes, OfSharedStructuresAreTheHosts) {
  Frame frame = small_frame();
  frame.tolerance = 0;
  const FramePlan plan = make_plan(frame);
  const Specialization variant(frame, plan, device().traits);
  const ProgramSource project = variant.project(ProjectOutput::splats);
  EXPECT_EQ(size_on_device(project, "ProjectParameters"), sizeof(shared::ProjectParameters));
  EXPECT_EQ(size_on_device(project, "ExtendedParameters"), sizeof(shared::ExtendedParameters));
  EXPECT_EQ(size_on_device(project, "ExtendedSplat"), sizeof(shared::ExtendedSplat));
  EXPECT_EQ(size_on_device(project, "ComponentColors"), sizeof(shared::ComponentColors));
  EXPECT_EQ(size_on_device(project, "BlockCounts"), sizeof(shared::BlockCounts));
  EXPECT_EQ(size_on_device(project, "BlockBox"), sizeof(shared::BlockBox));
  EXPECT_EQ(size_on_device(project, "Grid"), sizeof(shared::Grid));
  EXPECT_EQ(size_on_device(variant.bin(), "BinParameters"), sizeof(shared::BinParameters));
  EXPECT_EQ(size_on_device(variant.bin(), "Segment"), sizeof(shared::Segment));
  EXPECT_EQ(size_on_device(variant.composite(), "CompositeParameters"),
            sizeof(shared::CompositeParameters));
  EXPECT_EQ(size_on_device(variant.resolve(), "ResolveParameters"),
            sizeof(shared::ResolveParameters));
  const ProgramSource grids = variant.coarse_grids();
  EXPECT_EQ(size_on_device(variant.blur_strips(), "BlurStripsParameters"),
            sizeof(shared::BlurStripsParameters));
  EXPECT_EQ(size_on_device(grids, "BlurParameters"), sizeof(shared::BlurParameters));
  EXPECT_EQ(size_on_device(grids, "RefineParameters"), sizeof(shared::RefineParameters));
  EXPECT_EQ(size_on_device(Specialization::sort(), "SortParameters"),
            sizeof(shared::SortParameters));
  EXPECT_EQ(size_on_device(Specialization::sort(), "KeyBits"), sizeof(shared::KeyBits));
  const ProgramSource between = Specialization::interpolate(true);
  EXPECT_EQ(size_on_device(between, "InterpolateParameters"),
            sizeof(shared::InterpolateParameters));
  EXPECT_EQ(size_on_device(between, "PathParameters"), sizeof(shared::PathParameters));
}

}  // namespace
}  // namespace splotchcl::test
