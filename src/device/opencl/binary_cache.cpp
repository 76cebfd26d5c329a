#include "device/opencl/binary_cache.h"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

namespace splotchcl {
namespace {

// What a file holds: this line, the key, its end, the binary and how many bytes that has.
constexpr char first_line[] = "splotchcl kernels 1\n";
constexpr char end_of_key = '\0';

// FNV-1a: it only has to spread names.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : text) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  }
  return hash;
}

std::string head_of(const std::string& key, std::size_t bytes) {
  return first_line + std::to_string(bytes) + '\n' + key + end_of_key;
}

}  // namespace

std::optional<std::filesystem::path> BinaryCache::user_folder() {
  if (const char* const own = std::getenv("SPLOTCHCL_CACHE"); own != nullptr) {
    if (*own == '\0') return std::nullopt;
    return std::filesystem::path(own);
  }
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return std::filesystem::path(cache) / "splotchcl";
  }
  if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".cache" / "splotchcl";
  }
  return std::nullopt;
}

std::filesystem::path BinaryCache::file_for(const std::string& key) const {
  std::ostringstream name;
  name << std::hex << hash_of(key) << ".kernels";
  return *folder_ / name.str();
}

std::optional<std::string> BinaryCache::find(const std::string& key) const {
  if (!folder_) return std::nullopt;
  std::ifstream file(file_for(key), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::size_t key_end = text.find(end_of_key);
  if (key_end == std::string::npos) return std::nullopt;
  std::string binary = text.substr(key_end + 1);
  if (binary.empty() || text.compare(0, key_end + 1, head_of(key, binary.size())) != 0) {
    return std::nullopt;
  }
  return binary;
}

void BinaryCache::keep(const std::string& key, const std::string& binary) const {
  if (!folder_ || binary.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(*folder_, failure);
  const std::filesystem::path file = file_for(key);
  std::filesystem::path unfinished = file;
  unfinished += "." + std::to_string(std::random_device()());
  {
    std::ofstream out(unfinished, std::ios::binary);
    out << head_of(key, binary.size()) << binary;
    out.close();
    if (!out) {
      std::filesystem::remove(unfinished, failure);
      return;
    }
  }
  std::filesystem::rename(unfinished, file, failure);
  if (failure) std::filesystem::remove(unfinished, failure);
}

}  // namespace splotchcl
