#include "view/draw_loop.h"

#include <chrono>
#include <exception>
#include <filesystem>
#include <utility>

#include "finish/tone.h"
#include "splotchcl/error.h"
#include "view/answers.h"
#include "view/view_scene.h"

namespace splotchcl::view {
namespace {

using Stage = FrameScheduler::Stage;
using Clock = std::chrono::steady_clock;

constexpr double preview_seconds = 1.0 / 30;
constexpr std::size_t most_questions = 32;
constexpr std::size_t histogram_bins = 64;
// Enough to find what lies under the pointer.
constexpr std::uint64_t particles_to_pick = 200000;
// Of a small plan of the scene.
constexpr std::size_t places_shown = 2000;

ViewDrawer::Options with_go_on(ViewDrawer::Options options, std::function<bool()> go_on) {
  options.go_on = std::move(go_on);
  return options;
}

// A snapshot's picture whose size nobody has chosen.
bool fills_window(const ViewDrawer& drawer) {
  const Scene* const suggested = drawer.suggested();
  if (suggested == nullptr) return false;
  const ImageSettings &now = drawer.opened().image, &chosen = suggested->image;
  return now.width == chosen.width && now.height == chosen.height;
}

}  // namespace

DrawLoop::Page::Page(SendToPage to_page, std::uint64_t particles)
    : send(std::move(to_page)), quality(particles, preview_seconds) {}

DrawLoop::DrawLoop(SceneWithSnapshot source, const ViewDrawer::Options& options,
                   std::vector<std::string>& notes)
    : drawer_(std::move(source), with_go_on(options, [this] { return go_on(); }), notes),
      description_(describe_scene(drawer_.opened(), *drawer_.snapshot_of(drawer_.opened()),
                                  fills_window(drawer_))),
      films_(options.device, [this](const FilmProgress& film) { tell_all(film_message(film)); }),
      thread_([this] { run(); }) {}

DrawLoop::~DrawLoop() {
  stop();
}

void DrawLoop::stop() {
  stop_within(std::chrono::milliseconds(0));
  if (thread_.joinable()) thread_.join();
}

bool DrawLoop::stop_within(std::chrono::milliseconds patience) {
  films_.interrupt();
  std::unique_lock lock(mutex_);
  is_stopping_ = true;
  changed_.notify_all();
  return changed_.wait_for(lock, patience, [this] { return has_ended_; });
}

std::uint64_t DrawLoop::open_page(SendToPage send) {
  send({false, description_});
  if (const auto film = films_.progress()) send({false, film_message(*film)});
  const std::lock_guard lock(mutex_);
  auto page = std::make_shared<Page>(std::move(send), drawer_.particles());
  page->input = page->scheduler.take_input(false, Clock::now());
  pages_[++last_page_] = std::move(page);
  changed_.notify_all();
  return last_page_;
}

void DrawLoop::close_page(std::uint64_t page) {
  const std::lock_guard lock(mutex_);
  const auto found = pages_.find(page);
  if (found == pages_.end()) return;
  found->second->is_closed = true;
  pages_.erase(found);
}

void DrawLoop::take(std::uint64_t number, const PageMessage& message) {
  if (std::holds_alternative<CancelFilm>(message)) return films_.cancel();
  const std::lock_guard lock(mutex_);
  const auto found = pages_.find(number);
  if (found == pages_.end()) return;
  Page& page = *found->second;
  if (const auto* state = std::get_if<PageState>(&message)) {
    page.state = *state;
    page.input = page.scheduler.take_input(state->is_moving, Clock::now());
  } else if (const auto* acknowledged = std::get_if<FrameAcknowledged>(&message)) {
    page.scheduler.acknowledge(acknowledged->frame);
  } else {
    if (page.questions.size() >= most_questions) {
      throw UsageError("too many questions of the page wait for their answers, expected 32");
    }
    page.questions.push_back(std::get<PageQuestion>(message));
  }
  changed_.notify_all();
}

std::optional<DrawLoop::Work> DrawLoop::find_work(FrameScheduler::Time now) {
  auto next = pages_.upper_bound(last_served_);
  for (std::size_t i = 0; i < pages_.size(); ++i, ++next) {
    if (next == pages_.end()) next = pages_.begin();
    Page& page = *next->second;
    const std::optional<FrameScheduler::Task> task = page.scheduler.next(now);
    // A picture that takes long lets questions pass.
    const bool has_question = !page.questions.empty();
    if (!has_question && !task) continue;
    last_served_ = next->first;
    Work work{next->second, FrameScheduler::Task(), page.state, page.input};
    if (has_question && !(task && task->stage == Stage::preview)) {
      work.what = page.questions.front();
      page.questions.pop_front();
    } else {
      work.what = *task;
    }
    return work;
  }
  return std::nullopt;
}

std::optional<FrameScheduler::Time> DrawLoop::wake_time() const {
  std::optional<FrameScheduler::Time> first;
  for (const auto& [number, page] : pages_) {
    const std::optional<FrameScheduler::Time> time = page->scheduler.wake_time();
    if (time && (!first || *time < *first)) first = time;
  }
  return first;
}

std::optional<DrawLoop::Work> DrawLoop::wait_for_work() {
  std::unique_lock lock(mutex_);
  while (!is_stopping_) {
    if (auto work = find_work(Clock::now())) return work;
    if (const auto time = wake_time()) {
      changed_.wait_until(lock, *time);
    } else {
      changed_.wait(lock);
    }
  }
  return std::nullopt;
}

bool DrawLoop::go_on() {
  const std::lock_guard lock(mutex_);
  if (is_stopping_) return false;
  if (!exact_page_) return true;
  return !exact_page_->is_closed && !exact_page_->scheduler.is_outdated(exact_task_);
}

void DrawLoop::set_task(const Work& work) {
  const std::lock_guard lock(mutex_);
  exact_page_ = nullptr;
  const auto* task = std::get_if<FrameScheduler::Task>(&work.what);
  if (task == nullptr || task->stage == Stage::preview) return;
  exact_page_ = work.page;
  exact_task_ = *task;
}

// Kernels are compiled before the first page asks.
void DrawLoop::warm_up() {
  try {
    drawer_.preview(drawer_.opened(), preview_levels(drawer_.particles()).front());
  } catch (const DrawingCancelled&) {
    // The program ends.
  } catch (const std::exception&) {
    // Each page is told when it is drawn for it.
  }
}

void DrawLoop::run() {
  warm_up();
  while (const std::optional<Work> work = wait_for_work()) {
    set_task(*work);
    try {
      carry_out(*work);
    } catch (const DrawingCancelled&) {
      // Something newer is to be drawn, or nothing any more.
    }
  }
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  changed_.notify_all();
}

void DrawLoop::carry_out(const Work& work) {
  if (const auto* question = std::get_if<PageQuestion>(&work.what)) {
    try {
      answer(work, *question);
    } catch (const std::exception& error) {
      work.page->send({false, question_error(question->id, text_for_page(error))});
    }
    return;
  }
  const auto& task = std::get<FrameScheduler::Task>(work.what);
  try {
    draw(work, task);
  } catch (const std::exception& error) {
    work.page->send({false, state_error(work.state.number, text_for_page(error))});
    const std::lock_guard lock(mutex_);
    work.page->scheduler.failed({Stage::preview, task.input});
    work.page->scheduler.failed({Stage::exact, task.input});
  }
}

void DrawLoop::tell_all(const std::string& message) {
  const std::lock_guard lock(mutex_);
  for (const auto& [number, page] : pages_)
    page->send({false, message});
}

std::vector<Component> DrawLoop::added_components(const PageState& state) {
  std::vector<Component> added;
  for (const std::string& type : state.added)
    added.push_back(drawer_.component_for(type));
  return added;
}

DrawLoop::PageScene DrawLoop::make_scene(const PageState& state) {
  PageScene scene;
  scene.made_from = state.scene;
  const std::vector<Component> added = added_components(state);
  scene.opened = with_components(drawer_.opened(), added);
  std::optional<Scene> suggested;
  if (drawer_.suggested() != nullptr) suggested = with_components(*drawer_.suggested(), added);
  scene.all = scene_of(scene.opened, suggested ? &*suggested : nullptr, state);
  scene.open = open_keys(scene.all);
  scene.all = drawer_.decide(scene.all);
  scene.shown = without_hidden(scene.all, state.hidden);
  return scene;
}

// A film that plays changes nothing but its frame.
DrawLoop::PageScene& DrawLoop::scene_of_page(const Work& work) {
  std::optional<PageScene>& known = work.page->scene;
  if (known && known->input == work.input) return *known;
  if (!known || known->made_from != work.state.scene) known = make_scene(work.state);
  known->input = 0;  // until all is there
  known->drawn = known->shown;
  known->film_values = "{}";
  if (const std::optional<int> frame = work.state.frame) {
    if (!known->film) {
      known->film = std::make_shared<FilmPath>(film_of(known->shown));
      known->film_of_all = std::make_shared<FilmPath>(film_of(known->all));
    }
    known->drawn = at_frame(*known->film, known->shown, *frame);
    known->film_values = describe_values(at_frame(*known->film_of_all, known->all, *frame),
                                         keys_of_keyframes(known->all));
  }
  known->input = work.input;
  return *known;
}

void DrawLoop::draw(const Work& work, const FrameScheduler::Task& task) {
  Page& page = *work.page;
  PageScene& scene = scene_of_page(work);
  ViewPicture picture;
  if (task.stage == Stage::preview) {
    picture = drawer_.preview(scene.drawn, page.quality.level());
    page.quality.drawn(picture.seconds);
  } else {
    picture = drawer_.exact(scene.drawn);
  }
  if (picture.finish) {  // the exact picture has the exposure that the preview has found
    take_tone(*picture.finish, scene.all.finish);
    take_tone(*picture.finish, scene.shown.finish);
    take_tone(*picture.finish, scene.drawn.finish);
  }
  FrameHeader header;
  header.state = work.state.number;
  header.stage = task.stage;
  header.decided = numbers_of(scene.all, scene.open);
  header.given_way = given_way(scene.opened, work.state, scene.all);
  header.film_values = scene.film_values;
  {
    const std::lock_guard lock(mutex_);
    header.frame = page.scheduler.sent(task);
  }
  page.send({true, frame_message(header, picture)});
}

void DrawLoop::answer(const Work& work, const PageQuestion& question) {
  PageScene& scene = scene_of_page(work);
  const std::string text = std::visit(
      [&](const auto& what) { return answer_to(scene, question.id, what); }, question.what);
  work.page->send({false, text});
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id,
                                const HistogramQuestion& question) {
  if (question.component >= scene.all.components.size()) {
    throw UsageError("histogram: there is no such component");
  }
  const Frame frame = drawer_.load(scene.all);
  const DrawnComponent& component = frame.components[question.component];
  return histogram_answer(
      id, field_histogram(component.particles.color, component.color.scaling, histogram_bins));
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id, const PickQuestion& question) {
  const Frame frame = drawer_.sample(scene.drawn, particles_to_pick);
  return pick_answer(id, probe(frame, question.x * frame.width, question.y * frame.height));
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id, const PlacesQuestion&) {
  return places_answer(id, some_places(drawer_.sample(scene.shown, places_shown), places_shown));
}

std::string DrawLoop::answer_to(PageScene&, std::uint64_t id, const ComponentQuestion& question) {
  const Component& component = drawer_.component_for(question.type);
  return component_answer(id,
                          describe_component(component, *drawer_.snapshot_of(drawer_.opened())));
}

std::string DrawLoop::answer_to(PageScene&, std::uint64_t id, const LookQuestion& question) {
  const Scene scene = drawer_.with_look(question.look);
  return settings_answer(id, describe_look(drawer_.opened(), scene));
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id, const SceneTextQuestion&) {
  return scene_text_answer(id, portable_scene_text(drawer_.opened()),
                           portable_scene_text(scene.shown));
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id, const SaveScene& question) {
  const SaveResult result =
      save_scene(question.path, question.may_replace, scene.shown,
                 {drawer_.opened(), scene.all, *drawer_.snapshot_of(scene.shown)});
  return save_answer(id, result, std::filesystem::absolute(question.path).string());
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id, const MakeFilm& question) {
  const std::filesystem::path film = std::filesystem::absolute(question.path);
  const std::filesystem::path scene_file = std::filesystem::path(film).replace_extension(".toml");
  const ViewInputs inputs = {drawer_.opened(), scene.all, *drawer_.snapshot_of(scene.shown)};
  films_.require_idle();
  SaveResult result = check_film_file(film, question.may_replace, inputs);
  if (result == SaveResult::saved)
    result = save_scene(scene_file, question.may_replace, scene.shown, inputs);
  if (result == SaveResult::saved) films_.start(scene_file, film);
  return save_answer(id, result, film.string());
}

std::string DrawLoop::answer_to(PageScene& scene, std::uint64_t id, const SavePicture& question) {
  const SaveResult result =
      check_picture(question.path, question.may_replace, scene.drawn,
                    {drawer_.opened(), scene.all, *drawer_.snapshot_of(scene.drawn)});
  if (result == SaveResult::saved) {
    const DrawnFrame drawn = drawer_.draw(scene.drawn, light_of_file(question.path));
    write_pictures(question.path, drawn.pictures, image_file_options(scene.drawn));
  }
  return save_answer(id, result, std::filesystem::absolute(question.path).string());
}

}  // namespace splotchcl::view
