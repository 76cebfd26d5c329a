#pragma once

#include <string>
#include <vector>

#include "device/opencl/opencl.h"

namespace splotchcl {

// What a program is made of: a file in kernels/, lines of #defines, and source that is no file
// (tests); with all that file and source include (flattened).
struct ProgramSource {
  std::string file = {};
  std::string defines = {};
  std::string variant = {};  // lines of #defines, of which it gets those of names that it mentions
  std::string more = {};
  // What is smaller than 1.2e-38 may be taken as 0. Some processors take a hundred times as long
  // for an operation on such a number as for another one.
  bool denormals_are_zero = false;
};

// What a program is told: "NAME" or "NAME value".
using Choices = std::vector<std::string>;

inline std::string flag(const std::string& name, bool is_set) {
  return name + (is_set ? " 1" : " 0");
}

// Lanes of a program that does not depend on the frame.
inline Choices lanes_of(bool rows) {
  return rows ? Choices{"LANES_8"} : Choices{};
}

std::string define(const std::string& choice);

ProgramSource program_source(const std::string& file, const Choices& choices = {});

// The same as a compiler takes it.
struct ProgramText {
  std::string options, source;
};

// Throws DeviceError for files that are not part of this build.
ProgramText text_of(const ProgramSource& source, const compute::device& device);

// The same for who reads declarations (Quirks), and is told not to: they take longer than all else
// of reading it. The program declares what it uses. What is compiled has the same bits.
ProgramText short_text_of(const ProgramText& text);

// A kernel's source with the files of kernels/ that it includes in place of its #includes, and what
// these include, each file once: compilers and their caches see one text. Files are named from the
// folder above kernels/ on. What is included within #if is known only where the same conditions
// hold, so that a file may stand in both branches of a choice, or again behind one.
// Throws DeviceError for a file that is not part of this build.
std::string flattened(const std::string& source);

// Those lines of #defines whose names the text mentions, if only in a comment.
std::string mentioned(const std::string& defines, const std::string& text);

}  // namespace splotchcl
