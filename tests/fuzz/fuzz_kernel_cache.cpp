// Files of the cache of compiled kernels with whatever in them: what is found is what was kept, or
// nothing.
#include "device/opencl/binary_cache.h"
#include "fuzz/fuzz.h"

void splotchcl::fuzz::fuzz_kernel_cache(const std::uint8_t* data, std::size_t size) {
  using splotchcl::BinaryCache;
  const std::filesystem::path folder =
      splotchcl::fuzz::scratch_file().parent_path() / "kernel_cache";
  const std::string key = "device\ndriver\nsource", binary(64, 'b');
  std::filesystem::remove_all(folder);
  const BinaryCache cache(folder);
  cache.keep(key, binary);
  const auto file = std::filesystem::directory_iterator(folder)->path();
  if (cache.find(key) != binary) std::abort();
  // The first byte says whether the rest replaces the file or is laid over it from some place on.
  std::string content;
  {
    std::ifstream in(file, std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string whole = content;
  const std::string input(reinterpret_cast<const char*>(data), size);
  if (size > 1 && data[0] < 200) {
    const std::size_t at = data[0] % content.size();
    content.replace(at, std::min(input.size() - 1, content.size() - at), input.substr(1));
  } else {
    content = input;
  }
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
  const auto found = cache.find(key);
  if (found && (content != whole || *found != binary)) std::abort();
}
