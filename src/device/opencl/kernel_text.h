#pragma once

#include <string>

namespace splotchcl {

// A kernel's source with the files of kernels/ that it includes in place of its #includes, and what
// these include, each file once: compilers and their caches see one text. Files are named from the
// folder above kernels/ on. What is included within #if is known only where the same conditions
// hold, so that a file may stand in both branches of a choice, or again behind one.
// Throws DeviceError for a file that is not part of this build.
std::string flattened(const std::string& source);

// Those lines of #defines whose names the text mentions, if only in a comment.
std::string mentioned(const std::string& defines, const std::string& text);

}  // namespace splotchcl
