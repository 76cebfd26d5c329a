// The variant alone says what #defines reach a kernel, and knows the sizes that follow from
// them.
#include "device/frame/variant.h"

#include <cctype>

#include "device/opencl/launch.h"
#include "device/stages.h"
#include "device/stages/stage_programs.h"
#include "matches.h"
#include "testing.h"

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

const fs::path variant_file = source_folder() / "src/device/frame/variant.cpp";

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
  return names_in(text_of(variant_file), R"re(["{]"?([A-Z][A-Z0-9_]+)[" ])re");
}

// What a stage chooses for a program of its own.
std::set<std::string> chosen_macros() {
  const fs::path stages = source_folder() / "src/device/stages/stage_programs.cpp";
  return names_in(text_of(stages), R"re("([A-Z][A-Z0-9_]+)[ "])re");
}

// What compilers have beyond the language, or do not bear.
std::set<std::string> macros_of_options() {
  return names_in(text_of(source_folder() / "src/device/opencl/program_text.cpp"),
                  R"re("-D([A-Z]\w+)")re");
}

TEST(Defines, AreWrittenInOnePlace) {
  for (const fs::path& file : files_below(source_folder() / "src")) {
    if (file == source_folder() / "src/device/opencl/program_text.cpp") continue;
    EXPECT_EQ(text_of(file).find("\"#define"), std::string::npos) << file;
  }
}

TEST(Defines, ThatKernelsAskForAreWrittenOrTheirOwn) {
  const std::string kernels = kernel_texts();
  const std::set<std::string> written = written_macros(), chosen = chosen_macros();
  const std::set<std::string> own = names_in(kernels, R"(#define (\w+))");
  const std::set<std::string> of_options = macros_of_options();
  EXPECT_GE(of_options.size(), 2u);
  for (const std::string& asked : names_in(
           kernels, R"((?:#ifdef |#ifndef |#if !?|#elif !?|&& !?|\|\| !?|defined\()([A-Z]\w+))")) {
    const bool of_the_language = asked.rfind("__", 0) == 0 || asked.rfind("cl_khr_", 0) == 0;
    EXPECT_TRUE(of_the_language || written.count(asked) || chosen.count(asked) ||
                own.count(asked) || of_options.count(asked))
        << asked;
  }
}

TEST(Defines, ThatAreWrittenAreReadByAKernel) {
  const std::set<std::string> words = words_of(kernel_texts());
  const std::set<std::string> written = written_macros(), chosen = chosen_macros();
  EXPECT_GT(written.size(), 15u);
  EXPECT_GT(chosen.size(), 5u);
  for (const std::set<std::string>& macros : {written, chosen}) {
    for (const std::string& macro : macros)
      EXPECT_EQ(words.count(macro), 1u) << macro;
  }
}

// A structure's name, and its size where the host has it.
struct SharedStructure {
  std::string name;
  std::size_t size;
};

class Sizes : public StageTest {
 protected:
  // Whether the device takes the structures, in the variant of this program, for what the host
  // does. A header declares them; compiling kernels, too, would take most of the time.
  static void expect_equal_sizes(ProgramSource source, const std::string& header,
                                 const std::vector<SharedStructure>& structures) {
    source.file = {};
    for (const std::string& name : std::vector<std::string>{"common/splat.h", header})
      source.more += "#include \"kernels/" + name + "\"\n";
    source.more += "__kernel void sizes(__global uint* result) {\n";
    for (std::size_t i = 0; i < structures.size(); ++i) {
      source.more += "  result[" + std::to_string(i) + "] = sizeof(" + structures[i].name + ");\n";
    }
    source.more += "}\n";
    const auto result = device().pool.get<cl_uint>(structures.size(), "sizes");
    Launch(device(), "test", device().programs.get(source).create_kernel("sizes"))
        .arg(result)
        .run_items(1);
    const std::vector<cl_uint> found = device().pool.download(result, structures.size());
    for (std::size_t i = 0; i < structures.size(); ++i)
      EXPECT_EQ(found[i], structures[i].size) << structures[i].name;
  }

  static void expect_splats_of_equal_sizes(const Frame& frame) {
    const FramePlan plan = make_plan(frame);
    const Variant variant(frame, plan, device().traits);
    std::vector<SharedStructure> structures = {{"Splat", variant.splat_bytes()},
                                               {"TileSplat", variant.tile_splat_bytes()}};
    if (variant.extended) structures.push_back({"ExtendedSplat", variant.extended_splat_bytes()});
    expect_equal_sizes(bin_program(variant), "bin/bin.h", structures);
  }

  static Frame small_frame() {
    return frame_of(20, 10, {component_of({{0, 0, 1, 1, 1}}, two_colors())});
  }
};

TEST_F(Sizes, OfSplatsAreTheKernelsInEveryVariant) {
  Frame frame = small_frame();
  expect_splats_of_equal_sizes(frame);
  frame.components.front().absorption = {Absorption::Kind::gray, 1};
  expect_splats_of_equal_sizes(frame);
  frame.components.front().particles.color_vector = Column::owning({1, 1, 1});
  expect_splats_of_equal_sizes(frame);
  frame.tolerance = 0;
  expect_splats_of_equal_sizes(frame);
  frame.projection = Projection::equirectangular;
  expect_splats_of_equal_sizes(frame);
  frame.components.front().absorption = {Absorption::Kind::none, 0};
  expect_splats_of_equal_sizes(frame);
}

TEST_F(Sizes, OfSharedStructuresAreTheHosts) {
  Frame frame = small_frame();
  frame.tolerance = 0;
  const FramePlan plan = make_plan(frame);
  const Variant variant(frame, plan, device().traits);
  expect_equal_sizes(project_program(variant, ProjectOutput::splats), "project/project.h",
                     {{"ProjectParameters", sizeof(shared::ProjectParameters<double>)},
                      {"SharpParameters", sizeof(shared::SharpParameters)},
                      {"ExtendedSplat", sizeof(shared::ExtendedSplat)},
                      {"ComponentColors", sizeof(shared::ComponentColors)},
                      {"BlockCounts", sizeof(shared::BlockCounts)},
                      {"BlockBox", sizeof(shared::BlockBox)},
                      {"Grid", sizeof(shared::Grid)}});
  expect_equal_sizes(
      bin_program(variant), "bin/bin.h",
      {{"BinParameters", sizeof(shared::BinParameters)}, {"Segment", sizeof(shared::Segment)}});
  expect_equal_sizes(composite_program(variant), "composite/composite.h",
                     {{"CompositeParameters", sizeof(shared::CompositeParameters)}});
  expect_equal_sizes(resolve_program(variant), "resolve/resolve.h",
                     {{"ResolveParameters", sizeof(shared::ResolveParameters)}});
  expect_equal_sizes(blur_program(variant), "resolve/resolve.h",
                     {{"BlurStripsParameters", sizeof(shared::BlurStripsParameters)}});
  expect_equal_sizes(refine_program(variant), "resolve/resolve.h",
                     {{"BlurParameters", sizeof(shared::BlurParameters)},
                      {"RefineParameters", sizeof(shared::RefineParameters)}});
  expect_equal_sizes(
      program_source("kernels/sort/sort.cl"), "sort/sort.h",
      {{"SortParameters", sizeof(shared::SortParameters)}, {"KeyBits", sizeof(shared::KeyBits)}});
  expect_equal_sizes(program_source("kernels/interpolate/interpolate.cl", lanes_of(true)),
                     "interpolate/interpolate.h",
                     {{"InterpolateParameters", sizeof(shared::InterpolateParameters)},
                      {"PathParameters", sizeof(shared::PathParameters)}});
}

}  // namespace
}  // namespace splotchcl::test
