#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "splotchcl/image.h"

namespace splotchcl {

// Throws UsageError when the ending names no format, DataError when the folder is
// missing or not writable. Called before anything is read or drawn.
void check_image_path(const std::filesystem::path& path);

struct ImageFileOptions {
  double gamma = 1;  // 8- and 16-bit formats store value^(1/gamma); EXR stays linear
  std::map<std::string, std::string> metadata;
};

// Written under a temporary name in the same folder and renamed when complete.
void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageFileOptions& options = {});

Image read_image(const std::filesystem::path& path);

}  // namespace splotchcl
