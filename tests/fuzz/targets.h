#pragma once

#include <cstddef>
#include <cstdint>

// What libFuzzer's bytes may be fed to: each a target of scripts/fuzz.
namespace splotchcl::fuzz {

void fuzz_c_interface(const std::uint8_t* data, std::size_t size);
void fuzz_device(const std::uint8_t* data, std::size_t size);
void fuzz_formula(const std::uint8_t* data, std::size_t size);
void fuzz_gadget(const std::uint8_t* data, std::size_t size);
void fuzz_halo_list(const std::uint8_t* data, std::size_t size);
void fuzz_hdf5(const std::uint8_t* data, std::size_t size);
void fuzz_hdf5_layouts(const std::uint8_t* data, std::size_t size);
void fuzz_image(const std::uint8_t* data, std::size_t size);
void fuzz_kernel_cache(const std::uint8_t* data, std::size_t size);
void fuzz_numpy(const std::uint8_t* data, std::size_t size);
void fuzz_palette(const std::uint8_t* data, std::size_t size);
void fuzz_path(const std::uint8_t* data, std::size_t size);
void fuzz_scene(const std::uint8_t* data, std::size_t size);
void fuzz_text(const std::uint8_t* data, std::size_t size);
void fuzz_tipsy(const std::uint8_t* data, std::size_t size);
void fuzz_tipsy_array(const std::uint8_t* data, std::size_t size);
void fuzz_tree(const std::uint8_t* data, std::size_t size);

}  // namespace splotchcl::fuzz
