#pragma once

#include <cstddef>
#include <cstdint>

// What libFuzzer's bytes may be fed to, each in the file of its name. Each returns 0.
namespace splotchcl::fuzz {

int fuzz_c_interface(const std::uint8_t* data, std::size_t size);
int fuzz_device(const std::uint8_t* data, std::size_t size);
int fuzz_formula(const std::uint8_t* data, std::size_t size);
int fuzz_gadget(const std::uint8_t* data, std::size_t size);
int fuzz_halo_list(const std::uint8_t* data, std::size_t size);
int fuzz_hdf5(const std::uint8_t* data, std::size_t size);
int fuzz_hdf5_layouts(const std::uint8_t* data, std::size_t size);
int fuzz_image(const std::uint8_t* data, std::size_t size);
int fuzz_kernel_cache(const std::uint8_t* data, std::size_t size);
int fuzz_numpy(const std::uint8_t* data, std::size_t size);
int fuzz_palette(const std::uint8_t* data, std::size_t size);
int fuzz_path(const std::uint8_t* data, std::size_t size);
int fuzz_scene(const std::uint8_t* data, std::size_t size);
int fuzz_text(const std::uint8_t* data, std::size_t size);
int fuzz_tipsy(const std::uint8_t* data, std::size_t size);
int fuzz_tipsy_array(const std::uint8_t* data, std::size_t size);
int fuzz_tree(const std::uint8_t* data, std::size_t size);

}  // namespace splotchcl::fuzz
