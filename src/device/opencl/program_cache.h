#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/opencl/binary_cache.h"
#include "device/opencl/opencl.h"
#include "device/opencl/program_text.h"
#include "splotchcl/program_compiler.h"

namespace splotchcl {

// Throws DeviceError with the compiler's first message; `names` says of what.
compute::program build_program(const compute::context& context, const ProgramText& text,
                               const std::string& names);

// The other process's part: compiles in this one, on the first device of the names that are asked
// for. Gives nothing where that fails. Keeps what PoCL has read for its first program.
class LocalCompiler : public ProgramCompiler {
 public:
  std::string compile(const ProgramToCompile& program) override;

 private:
  const compute::context* context_on(const std::string& device);  // null: there is no such device

  std::map<std::string, compute::context> contexts_;
};

// Items 0 to `count` are done one by one, in this order: each by whoever is free first of the
// calling thread, which calls `here`, and of the `elsewhere`, each called in a thread of its own.
// One of these that returns false has not done its item, and gets no other. Returns when all items
// have been given out and ended. An exception of `here` is thrown when the others have ended the
// item that they are at; they throw none.
void share_work(std::size_t count, const std::function<void(std::size_t item)>& here,
                const std::vector<std::function<bool(std::size_t item)>>& elsewhere);

class ProgramCache;

// A program that has been asked for, which is compiled when a kernel of it is first needed, or with
// others before (ProgramCache::compile_all). As long-lived as its cache.
class Program {
 public:
  Program() = default;
  // Throws DeviceError with the compiler's first message.
  compute::kernel create_kernel(const std::string& name) const;

 private:
  friend class ProgramCache;
  struct Entry {
    std::string key, name;
    ProgramText text;
    std::optional<ProgramText> fallback;  // where the compiler does not take the text
    std::optional<std::string> binary;    // that an earlier run has compiled
    std::optional<compute::program> compiled;
  };
  Program(ProgramCache& cache, Entry& entry) : cache_(&cache), entry_(&entry) {}

  ProgramCache* cache_ = nullptr;
  Entry* entry_ = nullptr;
};

// Compiled programs of one context, keyed on device, driver, options and source.
// Binaries of earlier runs are taken from the user's cache folder.
class ProgramCache {
 public:
  explicit ProgramCache(const compute::context& context)
      : context_(context), binaries_(BinaryCache::user_folder()) {}
  ProgramCache(const ProgramCache&) = delete;
  ProgramCache& operator=(const ProgramCache&) = delete;

  Program get(const ProgramSource& source);
  // What has been asked for and no earlier run has compiled. Many are shared out to other
  // processes, if there is a way to start them. The compiler takes some milliseconds to read what
  // an earlier run has compiled: that waits for the first kernel, while the device may draw with
  // others. Throws as create_kernel.
  void compile_all();
  void use_compilers(StartCompiler start_compiler) { start_compiler_ = std::move(start_compiler); }

  // All that have been asked for, as compilers get them that declare the language's functions.
  std::vector<ProgramText> texts() const;

  double build_seconds() const { return build_seconds_; }
  // Why compiled programs are not kept from run to run; empty: they are, or need not be.
  const std::string& note() const { return binaries_.note(); }

 private:
  friend class Program;
  using Entry = Program::Entry;

  Entry entry_of(const ProgramSource& source) const;
  const compute::program& compiled(Entry& entry);
  bool find_binary(Entry& entry);
  bool restore(Entry& entry);
  void build(Entry& entry);
  void build_together(std::vector<Entry*> missing);
  std::size_t compilers_for(std::size_t programs) const;

  compute::context context_;
  BinaryCache binaries_;
  std::map<std::string, Entry> programs_;  // by their keys
  // By what they were asked for with: a frame asks for dozens, chunk by chunk, and putting a
  // source's files together takes longer than drawing a small chunk. Variants share programs.
  std::map<std::string, Entry*> asked_for_;
  StartCompiler start_compiler_;
  bool has_built_ = false;  // so that PoCL's library has been read
  double build_seconds_ = 0;
};

}  // namespace splotchcl
