// Predicts what a frame would take on GPUs that are not at hand: draws it with the kernels and the
// sizes for GPUs on any device, counts bytes, operations and chains of steps, and divides by what
// vendors say of their devices.
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>

#include "arguments.h"
#include "gpu_model/count_work.h"
#include "gpu_model/prediction.h"
#include "gpu_model/scene_frame.h"
#include "splotchcl/error.h"
#include "synthetic.h"
#include "table.h"

namespace splotchcl::bench {
namespace {

LightPlan light_of(const std::string& name) {
  for (const LightPlan light : {LightPlan::emission, LightPlan::proportional, LightPlan::ordered}) {
    if (name == splotchcl::name(light)) return light;
  }
  throw UsageError("--light: found '" + name + "', expected emission, proportional or ordered");
}

void print_work(const CountedWork& counted, const std::vector<KernelWork>& kernels) {
  const FrameWork& work = counted.work;
  if (work.particles > 0) {
    std::cout << std::fixed << "particles " << work.particles / 1e6 << " M, splats "
              << work.splats / 1e6 << " M, entries " << work.entries / 1e6 << " M, pixel updates "
              << 32 * work.drawn_parts() / 1e9 << " G at most (" << 32 * work.thin_parts / 1e9
              << " G of thin layers), by the error function " << work.mean_entries / 1e6
              << " M entries, by its complement " << work.bright_entries / 1e6
              << " M, longest list of a chunk " << work.longest_list << "\n\n";
  }
  Table table({"stage", "kernel", "launches", "M items", "least", "MB read", "MB written", "G ops",
               "chain", "KiB local", "barriers", "ms here"});
  for (const KernelWork& k : kernels) {
    table.add({k.stage, k.kernel, fixed(k.launches, 0), fixed(k.items / 1e6, 2),
               fixed(k.least_items, 0), fixed(k.cost.bytes_read / 1e6, 1),
               fixed(k.cost.bytes_written / 1e6, 1), fixed(k.cost.operations / 1e9, 2),
               fixed(k.cost.chain, 0), fixed(static_cast<double>(k.local_bytes) / 1024, 1),
               std::to_string(k.cost.barriers), fixed(1e3 * k.seconds, 3)});
  }
  std::cout << table.text() << "\n";
}

// For scripts/check_gpu_model: what is added up over the launches of each kernel.
void write_counters(const std::string& path, const std::vector<KernelWork>& kernels) {
  std::ofstream file(path);
  file << "stage,kernel,launches,items,bytes_read,bytes_written,operations\n"
       << std::setprecision(15);
  for (const KernelWork& k : kernels) {
    file << k.stage << ',' << k.kernel << ',' << k.launches << ',' << k.items << ','
         << k.cost.bytes_read << ',' << k.cost.bytes_written << ',' << k.cost.operations << '\n';
  }
  if (!file.flush()) throw DataError(path + ": cannot write the counters");
}

// For scripts/check_gpu_registers: the programs of the frame, each in a file.
void write_texts(const std::string& folder, const ProgramCache& programs) {
  int number = 0;
  for (const ProgramText& text : programs.texts()) {
    const std::string path = folder + "/program_" + std::to_string(++number) + ".cl";
    std::ofstream file(path);
    file << text.source;
    if (!file.flush()) throw DataError(path + ": cannot write the program");
  }
}

// Milliseconds of each stage, and of the kernel that takes most of it what it waits for.
void print_prediction(const std::vector<KernelWork>& kernels) {
  std::vector<std::string> columns = {"stage", "measured here"};
  for (const DeviceSheet& device : device_sheets())
    columns.emplace_back(device.name);
  Table table(columns);
  std::vector<double> totals(device_sheets().size());
  double total_here = 0;
  std::vector<std::string> stages;
  for (const KernelWork& kernel : kernels) {
    if (stages.empty() || std::find(stages.begin(), stages.end(), kernel.stage) == stages.end())
      stages.push_back(kernel.stage);
  }
  for (const std::string& stage : stages) {
    double seconds_here = 0;
    for (const KernelWork& kernel : kernels) {
      if (kernel.stage == stage) seconds_here += kernel.seconds;
    }
    std::vector<std::string> cells = {stage, fixed(1e3 * seconds_here, 2)};
    total_here += seconds_here;
    for (std::size_t d = 0; d < device_sheets().size(); ++d) {
      double sum = 0, most = 0;
      std::string bound;
      for (const KernelWork& kernel : kernels) {
        if (kernel.stage != stage) continue;
        const RooflineTime time = roofline(kernel, device_sheets()[d]);
        sum += time.total();
        if (time.total() > most) bound = time.bound_by();
        most = std::max(most, time.total());
      }
      totals[d] += sum;
      cells.push_back(fixed(1e3 * sum, 2) + " (" + bound + ")");
    }
    table.add(cells);
  }
  std::vector<std::string> cells = {"all", fixed(1e3 * total_here, 2)};
  for (const double total : totals)
    cells.push_back(fixed(1e3 * total, 2));
  table.add(cells);
  std::cout << "Predicted milliseconds by what vendors say of these devices:\n\n" << table.text();
}

Frame made_up_frame(const Arguments& arguments) {
  UniverseSetup setup;
  setup.particles = static_cast<std::size_t>(arguments.number("particles", 1000000));
  Frame frame = universe_frame(make_universe(setup), arguments.number("width", 1400),
                               arguments.number("height", 1050));
  set_light(frame, light_of(arguments.text("light", "ordered")));
  return frame;
}

Frame frame_of(const Arguments& arguments) {
  if (!arguments.has("scene")) return made_up_frame(arguments);
  std::vector<std::string> settings;
  if (arguments.has("snapshot"))
    settings.push_back("snapshot=\"" + arguments.text("snapshot", "") + '"');
  return frame_of_scene(arguments.text("scene", ""), settings);
}

// A GPU draws it once before, for times without first touches of memory.
CountedWork count(DeviceContext& device, const Arguments& arguments) {
  const int runs = device.traits.is_gpu ? 2 : 1;
  CountedWork counted;
  if (arguments.has("sort")) {
    const auto pairs = static_cast<std::uint32_t>(arguments.number("sort", 0));
    for (int run = 0; run < runs; ++run)
      counted = count_sort(device, pairs);
    return counted;
  }
  const Frame frame = frame_of(arguments);
  for (int run = 0; run < runs; ++run)
    counted = count_frame(device, frame);
  return counted;
}

void predict(const Arguments& arguments) {
  DeviceContext device(choose_device(arguments.text("device", "")));
  std::cout << "Device at hand: " << device.device.name() << "\n\n";
  const CountedWork counted = count(device, arguments);
  const std::vector<KernelWork> kernels = add_up(counted.launches, counted.work);
  print_work(counted, kernels);
  if (arguments.has("counters")) write_counters(arguments.text("counters", ""), kernels);
  if (arguments.has("texts")) write_texts(arguments.text("texts", ""), device.programs);
  print_prediction(kernels);
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  return splotchcl::bench::run_main(
      count, words,
      {"particles=N: of the made-up universe, 1000000", "width=N: pixels, 1400",
       "height=N: pixels, 1050", "light=PLAN: emission, proportional or ordered, which is meant",
       "scene=FILE: draws this scene, not the made-up universe",
       "snapshot=FILE: absolute path of the scene's snapshot", "sort=N: only sorts so many pairs",
       "counters=FILE: also writes what each kernel does, as CSV",
       "texts=FOLDER: also writes the programs that drew it there",
       "device=NAME: part of a device's name"},
      splotchcl::bench::predict);
}
