// SPDX-License-Identifier: MIT
#include "app/viewer/viewer.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <thread>

#include "app/truth/interruption.h"
#include "app/viewer/side_labels.h"
#include "core/base/note.h"
#include "core/scene/built_in.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

constexpr double kLookInterval = 0.5;      // seconds between two checks of watched files
constexpr double kWaitInterval = 0.05;     // seconds between two checks of background work
constexpr double kFirstPatience = 0.3;     // seconds to place objects in a scene's first frame
constexpr double kLeastFrame = 1.0 / 120;  // seconds, if the display does not limit the rate

fs::path stateFile() {
  return stateFolder() / "viewer.json";
}

// Prints an error of `action` instead of throwing it: the window can no longer show it.
void orNote(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    fmt::print(stderr, "note: {}\n", error.what());
  }
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      state_(loadState(stateFile(), stateMessage_)),
      last_(firstSession()),
      session_(options.session, last_),
      bookmarks_(options.bookmarks.empty() ? configFolder() / "bookmarks"
                                           : fs::path(options.bookmarks)),
      panel_(session_, state_, bookmarks_),
      controls_(session_, panel_, bookmarks_, state_) {
  setNoteListener([notes = notes_](const std::string& line) {
    const std::lock_guard lock(notes->mutex);
    notes->lines.push_back(line);
  });
  std::error_code failed;
  const bool keptState = fs::exists(stateFile(), failed);
  if (!keptState && keepsSession()) {
    session_.say("Drag in the picture to orbit. F1 lists all keys, Ctrl+O opens a file.");
  }
  if (!stateMessage_.empty()) session_.say(stateMessage_, true);
  if (options_.fresh) state_.layout = {};
  if (last_ && last_->layout) state_.layout = *last_->layout;
  if (options_.size.x > 0) {
    state_.width = options_.size.x;
    state_.height = options_.size.y;
  }
  openScene(session_.firstScene());  // is read while the window opens
  openWindow();
  if (options_.size.x == 0 && !keptState) {
    const double unit = window_->unit();
    window_->resize(glm::uvec2(glm::round(unit * glm::dvec2(state_.width, state_.height))));
  }
  rebuild_.watch(session_.registry());
}

Viewer::~Viewer() {
  stage_.reset();
  other_.reset();
  difference_.reset();
  truth_.reset();
  screen_.reset();
  device_.reset();
  window_.reset();
}

void Viewer::run() {
  const truth::Interruption interruption;
  try {
    showFrames();
  } catch (...) {
    rescue();
    throw;
  }
  if (!options_.capture.empty()) saveCapture();
  orNote([&] { keepState(); });
  orNote([&] { keepSession(); });
}

// Saves state and unsaved work when an error or a signal ends the program.
void Viewer::rescue() {
  orNote([&] { keepState(); });
  orNote([&] { keepSession(); });
  orNote([&] {
    const fs::path folder = stateFolder() / ("rescued-" + timeStamp());
    fmt::print(stderr, "note: settings, objects and camera are saved; continue with: {}\n",
               session_.rescue(folder));
  });
}

void Viewer::showFrames() {
  while (!window_->closing() && (options_.frames == 0 || complete_ < options_.frames)) {
    if (truth::Interruption::asked()) throw truth::Interrupted();
    if (window_->wait(patience())) settle_ = kSettleFrames;
    // Frames drawn before the truth is traced do not count as complete.
    const bool hurry = options_.frames > 0 && !truth_->running();
    watchMotion();
    if (lookAround() || hurry) settle_ = std::max(settle_, 1);
    if (stage_ && retry_.wait > 0 && Clock::now() >= retry_.at) stage_->retry();
    if (turnSides()) settle_ = std::max(settle_, 1);
    const bool stale = !session_.paused && isStale();
    const bool due = settle_ > 0 || moving_ || stale || session_.continuous || session_.step ||
                     session_.isPlaying();
    const glm::uvec2 pixels = window_->pixels();
    if (!due || pixels.x == 0 || pixels.y == 0) continue;
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> since = now - lastFrame_;
    lastFrame_ = now;
    settle_ = std::max(settle_ - 1, 0);
    frame(since.count());
    ++drawn_;
    if (stage_ && !isStale()) {
      noteThumbnail();
      // A long list of objects takes seconds to write, which the first picture need not wait for.
      if (std::exchange(keepsLater_, false)) session_.attempt("session", [&] { keepSession(); });
    }
    if (stage_ && !isStale() && !truth_->running()) ++complete_;
    const std::chrono::duration<double> took = Clock::now() - now;
    if (took.count() < kLeastFrame) {
      std::this_thread::sleep_for(std::chrono::duration<double>(kLeastFrame) - took);
    }
  }
}

// Seconds to wait for an event.
double Viewer::patience() {
  const bool visible = window_->pixels().x > 0;
  const bool stale = !session_.paused && isStale();
  const bool runs = moving_ || session_.continuous || session_.isPlaying();
  if (visible && (settle_ > 0 || stale || runs)) return 0;
  const bool busy = loading_.running() || !rebuild_.building().empty() || tune_.started() ||
                    sequence_.started() || portal_.running();
  double seconds = busy || truth_->running() ? kWaitInterval : kLookInterval;  // notices signals
  if (inMotion_) {
    const std::chrono::duration<double> left = restsAt_ - Clock::now();
    seconds = std::clamp(left.count(), 0.0, seconds);
  }
  if (session_.split && session_.splitting.way == SplitWay::kFlicker) {
    const std::chrono::duration<double> left = turnAt_ - Clock::now();
    seconds = std::clamp(left.count(), 0.0, seconds);
  }
  return seconds;
}

// A camera that stops for less than kRest still moves: a drag does not flicker between a coarse and
// a fine picture.
void Viewer::watchMotion() {
  const bool moved = inMotion_;
  inMotion_ = session_.isPlaying() || Clock::now() < restsAt_;
  if (moved && !inMotion_) settle_ = std::max(settle_, 1);  // the picture at rest
}

// Checks scene loading, plugin builds, tune and truth. True if one of them has news.
bool Viewer::lookAround() {
  bool news = loading_.running();  // its progress
  // The panel has its width, and the picture its shape, after the first frame.
  if (loading_.running() && drawn_ > 0) takeScene();
  const Clock::time_point now = Clock::now();
  const std::string before = rebuild_.building();
  if (std::chrono::duration<double>(now - lastLook_).count() >= kLookInterval) {
    lastLook_ = now;
    session_.attempt("build", [&] { rebuild_.look(); });
  }
  if (const auto outcome = rebuild_.take()) {
    buildMessage_ = outcome->message;
    news = true;
    if (outcome->good) {
      Requests again;
      again.rescan = true;
      perform(again);
    }
  }
  {
    const std::lock_guard lock(notes_->mutex);
    for (const std::string& line : notes_->lines) session_.say("note: " + line);
    news |= !notes_->lines.empty();
    notes_->lines.clear();
  }
  news |= lookAtTune();
  news |= lookAtSequence();
  news |= lookAtPortal();
  session_.attempt("truth", [&] { news |= truth_->look(); });
  return news || before != rebuild_.building();
}

// Gives the text its size. If the user changes it, the window grows or shrinks with the panel, so
// that the picture keeps its size, as far as the screen has room.
void Viewer::fitText() {
  context_.setLight(state_.layout.light);
  const double text = state_.layout.textScale;
  const double before = std::exchange(textScale_, text);
  if (!context_.setScale(window_->scale() * static_cast<float>(text))) return;
  screen_->fontChanged();
  if (before == 0 || before == text || !panel_.shown) return;
  // ImGui takes the new font with the next frame.
  const double panel = state_.layout.panelWidth * ImGui::GetFontSize();
  const double next = state_.layout.panelWidth * ImGui::GetIO().Fonts->Fonts[0]->FontSize;
  const glm::uvec2 size = window_->size();
  // A size that the screen cut short does not count.
  if (size != textSize_) textPicture_ = std::max(size.x - panel, 0.0);
  textSize_ = window_->resize({static_cast<uint32_t>(textPicture_ + next), size.y});
}

void Viewer::frame(double seconds) {
  fitText();
  takeDropped();
  session_.advance(seconds);
  window_->feedInterface();
  ImGui::NewFrame();
  if (drawn_ <= 1) ImGui::SetWindowFocus(nullptr);  // at first, the keys belong to the picture
  const ImGuiIO& io = ImGui::GetIO();
  const Status now = status();
  Requests requests = panel_.draw(now, {io.DisplaySize.x, io.DisplaySize.y});
  if (panel_.scrolls) settle_ = std::max(settle_, 1);
  if (session_.split) {
    const float unit = 1 / io.DisplayFramebufferScale.x;
    drawSideLabels(session_, now, unit * glm::vec2(place().corner), unit * glm::vec2(place().size),
                   panel_.layout);
  }
  moving_ = controls_.update(place(), stage_.get(), window_->fingers(), seconds,
                             io.DisplayFramebufferScale.x, requests);
  if (controls_.steered()) {
    restsAt_ = Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kRest));
  }
  watchMotion();
  if (!ImGui::IsAnyItemActive()) session_.noteChanges();
  ImGui::Render();
  if (window_->hasMoreEvents()) settle_ = kSettleFrames;
  perform(requests);
  writeLayout();  // marks a picture that must be rendered as stale before the work begins
  updateStage();
  drawWindow();
  writeLayout();
}

void Viewer::perform(const Requests& requests) {
  if (requests.rescan) {
    session_.attempt("plugins", [&] {
      session_.rescan([&] {
        device_->wait();
        if (other_) other_->forget();
      });
      rebuild_.watch(session_.registry());
    });
    settle_ = kSettleFrames;
  }
  if (requests.tune) startTune(*requests.tune);
  if (requests.cancelTune) tune_.cancel();
  if (requests.sequence) startSequence();
  if (requests.cancelSequence) sequence_.cancel();
  performOpening(requests);
  if (requests.openSession) {
    session_.attempt("session", [&] { openSession(*requests.openSession); });
  }
  if (requests.saveSession) {
    session_.attempt("session", [&] { saveSessionTo(*requests.saveSession); });
  }
  if (requests.picture) savePicture();
  if (requests.copyCommand) {
    session_.attempt("command", [&] {
      const std::string command = session_.commandLine(place().size, backend_, deviceName());
      window_->setClipboard(command);
      session_.say(command);
    });
  }
  if (requests.backend) {
    session_.attempt("backend", [&] { changeBackend(*requests.backend); });
  }
  if (std::exchange(controls_.wantsFullScreen, false)) window_->toggleFullScreen();
  if (requests.quit) window_->close();
}

// The desktop's dialog comes first, the panel's own where there is none.
bool Viewer::lookAtPortal() {
  const auto outcome = portal_.take();
  if (!outcome) return false;
  if (outcome->missing) panel_.showOpenDialog();
  if (!outcome->path.empty()) openAny(outcome->path);
  settle_ = kSettleFrames;
  return true;
}

void Viewer::performOpening(const Requests& requests) {
  if (requests.scene) openScene(*requests.scene);
  if (requests.file) openAny(*requests.file);
  if (requests.openDialog) portal_.start();
  if (requests.closeFailure) failedScene_.clear();
  if (requests.cancelLoading && loading_.running()) {
    loading_.cancel();
    session_.say("loading is cancelled: " + sceneLabel(loading_.path()));
    if (!session_.scene) failedScene_ = session_.messages.back().text;
    panel_.thumbnails.read(state_.recent);
  }
  if (requests.openDialog || requests.closeFailure || requests.cancelLoading) {
    settle_ = kSettleFrames;
  }
}

// Another scene that is being read is given up.
void Viewer::openScene(const std::string& path) {
  loading_.cancel();
  failedScene_.clear();
  std::error_code failed;
  loading_.start(scene::findBuiltIn(path) != nullptr ? path : fs::absolute(path, failed).string());
}

void Viewer::takeScene() {
  const auto take = [&] {
    const auto scene = loading_.take();
    if (!scene) return;
    const std::string path = loading_.path();
    // Truth and stage refer to the old scene.
    truth_->stop();
    stage_.reset();
    if (other_) other_->forget();
    session_.setScene(scene, path, place().size);
    // The first picture shows the newest objects. Effects place them by rays, and the time for that
    // must not pass while the rays' scene is built.
    const bool holds = std::ranges::any_of(session_.effectsWithObjects(), [&](const auto& effect) {
      return session_.listOf(effect).size() > 0;
    });
    if (holds) {
      session_.services->rays().prepare();
      session_.services->rays().wait();
      updateSeconds_ = kFirstPatience;
    }
    retry_ = {};
    pictured_ = false;
    stage_ = std::make_unique<Stage>(*device_, *session_.scene, *session_.services, session_.chain);
    times_.clear();
    state_.noteRecent(path);
    keepState();
    keepsLater_ = true;
    nameWindow();
    settle_ = kSettleFrames;
  };
  // A run of so many frames would wait for the scene forever.
  if (options_.frames > 0) return take();
  if (session_.attempt("scene", take)) return;
  failedScene_ = session_.messages.back().text;
  panel_.thumbnails.read(state_.recent);
  settle_ = kSettleFrames;
}

void Viewer::openAny(const std::string& path) {
  if (isOfKind(path, FileKind::kScene)) {
    openScene(path);
  } else if (isSessionFile(path)) {
    session_.attempt("session", [&] { openSession(path); });
  } else {
    session_.attempt("file", [&] { session_.openFile(path); });
  }
}

void Viewer::takeDropped() {
  for (const std::string& path : window_->takeDropped()) openAny(path);
}

// Keeps a small picture of the scene, for the list of scenes opened last.
void Viewer::noteThumbnail() {
  const bool listed = !state_.recent.empty() && state_.recent.front() == session_.scenePath;
  if (pictured_ || !keepsSession() || !listed || !screen_->picture() || session_.split) return;
  pictured_ = true;
  session_.attempt("thumbnail", [&] {
    const Place where = place();
    const glm::uvec2 pixels = window_->pixels();
    const std::vector<std::byte> window = device_->read(screen_->picture());
    image::Image8 picture{.width = where.size.x, .height = where.size.y, .pixels = {}};
    for (uint32_t y = 0; y < where.size.y; ++y) {
      const size_t from = (size_t{y} * pixels.x + static_cast<size_t>(where.corner.x)) * 4;
      if (from + size_t{where.size.x} * 4 > window.size()) return;
      const auto* first = reinterpret_cast<const uint8_t*>(window.data()) + from;
      picture.pixels.insert(picture.pixels.end(), first, first + size_t{where.size.x} * 4);
    }
    panel_.thumbnails.save(session_.scenePath, picture);
  });
}

void Viewer::noteSize() {
  if (window_->isFullScreen()) return;
  const glm::uvec2 size = window_->size();
  if (size.x == 0 || size.y == 0) return;
  state_.width = std::min(size.x, 16384u);
  state_.height = std::min(size.y, 16384u);
}

// A run of so many frames leaves no trace.
void Viewer::keepState() {
  if (!keepsSession()) return;
  noteSize();
  saveState(state_, stateFile());
}

}  // namespace grisaille::app::viewer
