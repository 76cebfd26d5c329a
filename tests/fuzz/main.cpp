// All targets in one program, so that it is linked once; SPLOTCHCL_FUZZ_TARGET names the one to
// run.
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

#include "fuzz/targets.h"

namespace {

using Target = void (*)(const std::uint8_t*, std::size_t);

Target chosen_target() {
  using namespace splotchcl::fuzz;
  const std::map<std::string, Target> targets = {{"c_interface", fuzz_c_interface},
                                                 {"device", fuzz_device},
                                                 {"formula", fuzz_formula},
                                                 {"gadget", fuzz_gadget},
                                                 {"halo_list", fuzz_halo_list},
                                                 {"hdf5", fuzz_hdf5},
                                                 {"hdf5_layouts", fuzz_hdf5_layouts},
                                                 {"image", fuzz_image},
                                                 {"kernel_cache", fuzz_kernel_cache},
                                                 {"numpy", fuzz_numpy},
                                                 {"palette", fuzz_palette},
                                                 {"path", fuzz_path},
                                                 {"scene", fuzz_scene},
                                                 {"text", fuzz_text},
                                                 {"tipsy", fuzz_tipsy},
                                                 {"tipsy_array", fuzz_tipsy_array},
                                                 {"tree", fuzz_tree}};
  const char* const name = std::getenv("SPLOTCHCL_FUZZ_TARGET");
  const auto found = targets.find(name == nullptr ? "" : name);
  if (found != targets.end()) return found->second;
  std::cerr << "fuzz: SPLOTCHCL_FUZZ_TARGET: found '" << (name == nullptr ? "" : name)
            << "', expected one of";
  for (const auto& [known, target] : targets)
    std::cerr << ' ' << known;
  std::cerr << '\n';
  std::exit(2);
}

Target target() {
  static const Target chosen = chosen_target();
  return chosen;
}

}  // namespace

// Before anything is tried: a program that ends while it is would be a finding.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  target();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target()(data, size);
  return 0;
}
