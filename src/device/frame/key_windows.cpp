#include "device/frame/key_windows.h"

#include <algorithm>
#include <utility>

namespace splotchcl {

KeyWindow window_of_bin(const CountedKeys& counted, std::size_t bin) {
  const std::uint64_t width = std::uint64_t{1} << counted.shift;
  // The counted keys agree in all bits above those that number the bins.
  const std::uint64_t upper = counted.window.first >> (counted.shift + bits_of_key_bin)
                                                          << (counted.shift + bits_of_key_bin);
  KeyWindow window;
  window.first = std::max(counted.window.first, upper + bin * width);
  window.end = std::min(counted.window.end, upper + (bin + 1) * width);
  window.splats = counted.bins[bin];
  return window;
}

namespace {

class WindowChooser {
 public:
  WindowChooser(std::uint64_t capacity, const CountKeys& count)
      : capacity_(capacity), count_(count) {}

  void add(const CountedKeys& counted) {
    for (std::size_t bin = 0; bin < counted.bins.size(); ++bin) {
      if (counted.bins[bin] == 0) continue;
      const KeyWindow window = window_of_bin(counted, bin);
      if (window.splats > capacity_ && counted.shift > 0) {
        const int shift = counted.shift - bits_of_key_bin;
        add(count_(window, shift));
      } else {
        append(window);
      }
    }
  }

  std::vector<KeyWindow> windows() && { return std::move(windows_); }

 private:
  void append(const KeyWindow& window) {
    if (!windows_.empty() && windows_.back().splats + window.splats <= capacity_) {
      windows_.back().end = window.end;
      windows_.back().splats += window.splats;
    } else {
      windows_.push_back(window);
    }
  }

  const std::uint64_t capacity_;
  const CountKeys& count_;
  std::vector<KeyWindow> windows_;
};

}  // namespace

std::vector<KeyWindow> choose_windows(const CountedKeys& counted, std::uint64_t capacity,
                                      const CountKeys& count) {
  WindowChooser chooser(capacity, count);
  chooser.add(counted);
  return std::move(chooser).windows();
}

}  // namespace splotchcl
