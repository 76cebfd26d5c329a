// Looks for scenes whose pictures break the promise of their tolerance: docs/dev/contributing.md.
// usage: adversary [--minutes M] [--pictures N] [--seeds A..B] [--class NAME] [--findings FOLDER]
//                  [--light NAME] [--tolerance X] [--from FILE] [--csv FILE]
//        adversary --measure FILE...
//   --pictures  drawn for each class and seed, at most
//   --minutes   instead: the time for all, shared out evenly
//   --from      a scene of such a file is changed, instead of a class's random ones
//   --light, --tolerance  instead of those that follow from the seed
//   --findings  each scene beyond its promise, made simpler, becomes a file there
//   --csv       a line per search
//   --measure   draws the scenes of such files
// Without options: a short search over a sample of the classes, or with SPLOTCHCL_LONG_TESTS a
// long one over all. Exits with 1 if a promise was broken.
#include <chrono>
#include <cstdio>

#include "adversary/classes.h"
#include "adversary/judge.h"
#include "adversary/search.h"
#include "adversary/simplify.h"
#include "adversary/trial.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

struct Options {
  double minutes = 0;
  int pictures = 40;
  std::uint64_t first_seed = 0, last_seed = 0;
  std::vector<std::string> kinds;  // empty: all
  std::string given;               // choices and numbers that all starts take over, as in files
  std::string from, findings, csv;
  std::vector<std::string> measured;
};

// All classes but those of 2e5 particles and those that compile kernels of their own.
Options short_options() {
  Options options;
  options.pictures = 20;
  options.kinds = {"few_bright_clouds",
                   "crowd",
                   "corner_of_cells",
                   "crowds_in_rings",
                   "ring",
                   "lattice",
                   "line",
                   "mixed_widths",
                   "sheets",
                   "bright_stars",
                   "large_picture",
                   "ring_before_sheet",
                   "two_sources",
                   "tinted_matter",
                   "many_colors",
                   "clouds_around",
                   "certified",
                   "between_snapshots",
                   "map_mean",
                   "map_dispersion"};
  options.last_seed = 2;
  return options;
}

Options long_options() {
  Options options;
  options.minutes = 30;
  options.last_seed = 6;  // of each light
  return options;
}

void read_seeds(const std::string& word, Options& options) {
  const std::size_t dots = word.find("..");
  options.first_seed = std::stoull(word);
  options.last_seed =
      dots == std::string::npos ? options.first_seed : std::stoull(word.substr(dots + 2));
}

Options read_options(const std::vector<std::string>& words) {
  if (words.empty()) return test::long_tests() ? long_options() : short_options();
  Options options;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    if (words[i] == "--measure") {
      options.measured.assign(words.begin() + static_cast<std::ptrdiff_t>(i) + 1, words.end());
      return options;
    }
    if (i + 1 == words.size()) throw std::runtime_error(words[i] + " needs a value");
    const std::string& value = words[i + 1];
    if (words[i] == "--minutes") {
      options.minutes = std::stod(value);
    } else if (words[i] == "--pictures") {
      options.pictures = std::stoi(value);
    } else if (words[i] == "--seeds") {
      read_seeds(value, options);
    } else if (words[i] == "--class") {
      options.kinds.push_back(value);
    } else if (words[i] == "--light" || words[i] == "--tolerance") {
      options.given += words[i].substr(2) + " " + value + " ";
    } else if (words[i] == "--from") {
      options.from = value;
    } else if (words[i] == "--findings") {
      options.findings = value;
    } else if (words[i] == "--csv") {
      options.csv = value;
    } else {
      throw std::runtime_error("found '" + words[i] + "', expected an option: see main.cpp");
    }
  }
  return options;
}

Trial read_trial(const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error("cannot read " + name);
  return trial_of({std::istreambuf_iterator<char>(file), {}});
}

// The file's scene, a little changed, whatever the seed.
TrialClass class_from(const std::string& file) {
  const Trial trial = read_trial(file);
  return {std::filesystem::path(file).stem().string(),
          "it is close to one that is known",
          {},
          {},
          [trial](test::Random& random) { return changed(trial, 0.02, random); }};
}

std::vector<TrialClass> chosen_classes(const Options& options) {
  if (!options.from.empty()) return {class_from(options.from)};
  if (options.kinds.empty()) return all_classes();
  std::vector<TrialClass> chosen;
  for (const std::string& name : options.kinds) {
    const std::size_t before = chosen.size();
    for (const TrialClass& kind : all_classes()) {
      if (kind.name == name) chosen.push_back(kind);
    }
    if (chosen.size() == before) throw std::runtime_error("found no class '" + name + "'");
  }
  return chosen;
}

void print(const std::string& title, const Finding& finding) {
  const Measurement& m = finding.measurement;
  std::printf("%-22s %-12s %-6s %7.0e %10.2e %9.3g  at (%d, %d) %.6g for %.6g\n", title.c_str(),
              name(m.plan), name(finding.trial.shape), m.promise, m.error, m.ratio(), m.x, m.y,
              m.drawn, m.exact);
  std::fflush(stdout);
}

void print_heading() {
  std::printf("%-22s %-12s %-6s %7s %10s %9s\n", "class and seed", "plan", "shape", "promise",
              "error", "ratio");
}

// Where findings go: files of scenes, and a table.
class Record {
 public:
  explicit Record(const Options& options) : folder_(options.findings) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
    if (options.csv.empty()) return;
    csv_.open(options.csv);
    csv_ << "class,seed,plan,shape,tolerance,certified,measured,promise\n";
  }

  void add(std::uint64_t seed, const Finding& finding, Judge& judge) {
    const Trial& trial = finding.trial;
    const Measurement& m = finding.measurement;
    csv_ << trial.kind << "," << seed << "," << name(m.plan) << "," << name(trial.shape) << ","
         << trial.tolerance << "," << m.certified << "," << m.error << "," << m.promise << "\n";
    if (folder_.empty() || m.ratio() <= 1) return;
    const Finding simple = simplified(finding, judge);
    std::ofstream file(std::filesystem::path(folder_) /
                       (trial.kind + "_" + std::to_string(seed) + ".txt"));
    file << "# off by " << simple.measurement.ratio() << " times its promise\n"
         << text_of(simple.trial);
  }

 private:
  std::string folder_;
  std::ofstream csv_;
};

// Lets a search go on for so many pictures, or for its share of the time.
class Allowance {
 public:
  explicit Allowance(const Options& options, double searches)
      : pictures_(options.pictures), seconds_(60 * options.minutes / searches) {}

  std::function<bool()> next() const {
    using Clock = std::chrono::steady_clock;
    if (seconds_ > 0) {
      const auto end = Clock::now() + std::chrono::duration<double>(seconds_);
      return [end] { return Clock::now() < end; };
    }
    return [left = pictures_]() mutable { return left-- > 0; };
  }

 private:
  int pictures_;
  double seconds_;
};

int measure_files(const std::vector<std::string>& files) {
  Judge judge;
  print_heading();
  bool all_keep = true;
  for (const std::string& name : files) {
    const Trial trial = read_trial(name);
    const Finding finding{trial, judge.measure(trial)};
    print(std::filesystem::path(name).stem().string(), finding);
    all_keep &= finding.measurement.ratio() <= 1;
  }
  return all_keep ? 0 : 1;
}

Finding search_one(const TrialClass& kind, std::uint64_t seed, const std::string& given,
                   Judge& judge, const std::function<bool()>& goes_on) {
  test::Random random(1000 * seed + 17);
  const auto start = [&](test::Random& r) {
    Trial trial = start_of(kind, seed, r);
    set(given, trial);
    return trial;
  };
  return search(start, judge, random, goes_on);
}

int search_all(const Options& options) {
  const std::vector<TrialClass> kinds = chosen_classes(options);
  const auto seeds = static_cast<double>(options.last_seed - options.first_seed + 1);
  const Allowance allowance(options, seeds * static_cast<double>(kinds.size()));
  Record record(options);
  std::vector<Finding> worst(kinds.size());
  print_heading();
  for (std::uint64_t seed = options.first_seed; seed <= options.last_seed; ++seed) {
    // Renderers of their own, or all kernels that were ever compiled would stay.
    Judge judge;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const Finding finding = search_one(kinds[i], seed, options.given, judge, allowance.next());
      print(kinds[i].name + " " + std::to_string(seed), finding);
      record.add(seed, finding, judge);
      if (worst[i].trial.groups.empty() ||
          finding.measurement.ratio() > worst[i].measurement.ratio()) {
        worst[i] = finding;
      }
    }
  }
  std::printf("\nthe worst of each class\n");
  int broken = 0;
  for (const Finding& finding : worst) {
    print(finding.trial.kind, finding);
    if (finding.measurement.ratio() > 1) ++broken;
  }
  if (broken == 0) return 0;
  std::printf(
      "\n%d of %zu classes break their promise. The same search with --findings FOLDER\n"
      "writes the scenes; docs/dev/contributing.md says how one becomes a hard case.\n",
      broken, kinds.size());
  return 1;
}

}  // namespace
}  // namespace splotchcl::adversary

int main(int argc, char** argv) {
  try {
    using namespace splotchcl::adversary;
    const Options options = read_options({argv + 1, argv + argc});
    return options.measured.empty() ? search_all(options) : measure_files(options.measured);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "adversary: %s\n", error.what());
    return 2;
  }
}
