#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "film/path/film_path.h"
#include "view/film_maker.h"
#include "view/frame_scheduler.h"
#include "view/requests/page_messages.h"
#include "view/view_drawer.h"

namespace splotchcl::view {

// A message to a page.
struct OutgoingMessage {
  bool is_binary = false;
  std::string data;
};
// May be called from any thread, also when the page has gone.
using SendToPage = std::function<void(OutgoingMessage)>;

// Draws for all open pages in a thread of its own, one after the other, each what its newest state
// asks for. What goes wrong for a page is told to that page.
class DrawLoop {
 public:
  // `options.go_on` is not used. Throws as ViewDrawer does.
  DrawLoop(SceneWithSnapshot source, const ViewDrawer::Options& options,
           std::vector<std::string>& notes);
  ~DrawLoop();
  DrawLoop(const DrawLoop&) = delete;
  DrawLoop& operator=(const DrawLoop&) = delete;

  // Ends what is being drawn. Nothing is sent any more when it returns.
  void stop();
  // Asks for the same, and waits for no longer than that. Returns whether it has ended.
  bool stop_within(std::chrono::milliseconds patience);

  // A film that pages had made, by the number that they were told. For any thread.
  std::optional<std::filesystem::path> film(std::size_t number) const {
    return films_.film(number);
  }

  // For any thread. Returns the page's number.
  std::uint64_t open_page(SendToPage send);
  void close_page(std::uint64_t page);
  // Throws UsageError where too many questions wait for their answers.
  void take(std::uint64_t page, const PageMessage& message);

 private:
  // A page's state as a scene.
  struct PageScene {
    std::uint64_t input = 0;
    Scene opened;                // with the components that the page has added
    std::set<std::string> open;  // keys that the state leaves to data or picture
    Scene all;                   // with components that are off
    Scene shown;                 // without them
    Scene drawn;                 // at the film's frame, where that is shown
    // Of `shown` and of `all`, once they are asked for.
    std::shared_ptr<const FilmPath> film, film_of_all;
    std::string made_from;           // PageState::scene
    std::string film_values = "{}";  // as FrameHeader has them
  };
  struct Page {
    explicit Page(SendToPage to_page, std::uint64_t particles);

    SendToPage send;
    FrameScheduler scheduler;
    PageState state;
    std::uint64_t input = 0;
    std::deque<PageQuestion> questions;
    bool is_closed = false;
    // Of the drawing thread:
    PreviewQuality quality;
    std::optional<PageScene> scene;
  };
  struct Work {
    std::shared_ptr<Page> page;
    std::variant<FrameScheduler::Task, PageQuestion> what;
    PageState state;
    std::uint64_t input = 0;
  };

  void warm_up();
  void run();
  std::optional<Work> wait_for_work();
  std::optional<Work> find_work(FrameScheduler::Time now);
  std::optional<FrameScheduler::Time> wake_time() const;
  bool go_on();
  void set_task(const Work& work);

  void carry_out(const Work& work);
  void draw(const Work& work, const FrameScheduler::Task& task);
  void answer(const Work& work, const PageQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const HistogramQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const PickQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const PlacesQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const ComponentQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const LookQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const SceneTextQuestion& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const SaveScene& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const SavePicture& question);
  std::string answer_to(PageScene& scene, std::uint64_t id, const MakeFilm& question);
  void tell_all(const std::string& message);
  std::vector<Component> added_components(const PageState& state);
  PageScene make_scene(const PageState& state);
  PageScene& scene_of_page(const Work& work);

  ViewDrawer drawer_;  // of the drawing thread, once that runs
  std::string description_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::map<std::uint64_t, std::shared_ptr<Page>> pages_;
  std::uint64_t last_page_ = 0;    // the newest
  std::uint64_t last_served_ = 0;  // the next in turn is the one after it
  bool is_stopping_ = false;
  bool has_ended_ = false;
  // What is being drawn, where it may be overtaken.
  std::shared_ptr<Page> exact_page_;
  FrameScheduler::Task exact_task_;

  FilmMaker films_;  // tells all pages
  std::thread thread_;
};

}  // namespace splotchcl::view
