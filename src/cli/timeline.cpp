#include "cli/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "cli/json_answer.h"
#include "common/unfinished_file.h"

namespace splotchcl::cli {
namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

// Which row each span is shown in. Spans are asked for in the order in which they began.
class Rows {
 public:
  std::string row_of(const FilmSpan& film) {
    const TimeSpan& span = film.span;
    if (span.is_on_device) return "device";
    if (span.what == "load") return "load";
    if (span.what == "write") return "write " + std::to_string(free_writer(span) + 1);
    return "draw " + std::to_string(turn_of(film.frame) + 1);
  }

 private:
  std::size_t free_writer(const TimeSpan& span) {
    const auto found = std::find_if(writers_.begin(), writers_.end(),
                                    [&](Clock::time_point end) { return end <= span.begin; });
    const auto writer = found != writers_.end() ? found : writers_.insert(found, span.end);
    *writer = span.end;
    return static_cast<std::size_t>(writer - writers_.begin());
  }

  // A frame begins to be drawn after the last but one has ended.
  std::size_t turn_of(int frame) {
    constexpr std::size_t turns = 2;
    return turns_.emplace(frame, turns_.size() % turns).first->second;
  }

  std::vector<Clock::time_point> writers_;  // when each is free again
  std::map<int, std::size_t> turns_;
};

Json row_name(std::size_t number, const std::string& name) {
  return {{"name", "thread_name"},
          {"ph", "M"},
          {"pid", 1},
          {"tid", number},
          {"args", {{"name", name}}}};
}

}  // namespace

void write_timeline(const std::filesystem::path& path, const std::vector<FilmSpan>& spans) {
  std::vector<FilmSpan> in_order = spans;
  std::stable_sort(in_order.begin(), in_order.end(), [](const FilmSpan& a, const FilmSpan& b) {
    return a.span.begin < b.span.begin;
  });
  Json events = Json::array();
  Rows rows;
  std::map<std::string, std::size_t> numbers;
  for (const FilmSpan& film : in_order) {
    const TimeSpan& span = film.span;
    const std::string row = rows.row_of(film);
    const auto [number, is_new] = numbers.emplace(row, numbers.size() + 1);
    if (is_new) events.push_back(row_name(number->second, row));
    events.push_back({{"name", span.what},
                      {"ph", "X"},
                      {"pid", 1},
                      {"tid", number->second},
                      {"ts", microseconds(span.begin - in_order.front().span.begin)},
                      {"dur", microseconds(span.end - span.begin)},
                      {"args", {{"frame", film.frame}}}});
  }
  const std::string text = json_text({{"displayTimeUnit", "ms"}, {"traceEvents", events}});
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

}  // namespace splotchcl::cli
