// SPDX-License-Identifier: MIT
// The viewer: owns window, device, session and panel, and runs the loop that draws a frame when
// something has changed.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/viewer/controls.h"
#include "app/viewer/other_backend.h"
#include "app/viewer/portal.h"
#include "app/viewer/rebuild.h"
#include "app/viewer/scene_loading.h"
#include "app/viewer/screen.h"
#include "app/viewer/side_difference.h"
#include "app/viewer/truth_view.h"
#include "app/viewer/window.h"

namespace grisaille::app::viewer {

struct ViewerOptions {
  SessionOptions session;
  std::string backend, device;      // "": the first that starts
  std::string bookmarks;            // folder; "": configFolder()/bookmarks
  bool fresh = false;               // begin without the last session
  std::string sessionFile;          // begin with this session instead; "": the last one
  std::string layoutFile;           // receives the controls' rectangles; "": none
  glm::uvec2 size = glm::uvec2(0);  // of the window, screen units; 0: as in the last run
  // Ends after this number of complete frames: with the scene's picture and, if it is compared with
  // the truth, all rays traced. 0: ends when the user closes the window.
  uint32_t frames = 0;
  std::string capture;            // file for the window's last content, .png or .exr; "": none
  bool check = false;             // validate every call, in the layer and in the driver
  gpu::MessageSink message = {};  // receives the driver's messages; none: standard error
};

class Viewer {
 public:
  // Opens the window. Throws Error.
  explicit Viewer(const ViewerOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // Runs until the user closes the window. If an error or a signal ends it, saves settings, objects
  // and camera to a folder first. Throws Error and truth::Interrupted.
  void run();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kSettleFrames = 3;  // ImGui shows hover effects a frame or two late
  static constexpr double kRest = 0.25;    // seconds without motion until the picture rests

  // viewer.cpp
  void showFrames();
  void fitText();
  void rescue();
  double patience();
  void watchMotion();
  bool lookAround();
  void frame(double seconds);
  void perform(const Requests& requests);
  void performOpening(const Requests& requests);
  bool lookAtPortal();
  void openScene(const std::string& path);
  void openAny(const std::string& path);
  void noteThumbnail();
  void takeScene();
  void takeDropped();
  void noteSize();
  void keepState();
  // viewer_runs.cpp
  void startTune(const TuneWish& wish);
  bool lookAtTune();
  void startSequence();
  bool lookAtSequence();
  // viewer_session.cpp
  std::optional<SavedSession> firstSession();
  bool keepsSession() const { return options_.frames == 0; }
  void keepSession();
  void saveSessionTo(const std::string& path);
  void openSession(const std::string& path);
  SavedSession saved();
  // viewer_backend.cpp
  struct Opened {
    std::unique_ptr<Window> window;
    std::unique_ptr<gpu::Device> device;
  };
  void openWindow();
  Opened open(const backends::Backend& backend);
  gpu::DeviceOptions deviceOptions(const std::string& backend) const;
  void take(Opened opened, const std::string& backend);
  void changeBackend(const std::string& backend);
  void nameWindow();
  // The right side's picture on another backend: none if the window's backend renders it.
  std::optional<StageDesc> otherDesc();
  bool isOtherStale();
  void updateOther();
  std::string deviceName() const;  // --device, for the backend that it was given for
  // viewer_picture.cpp
  double placingPatience() const;
  StageDesc commonDesc();
  StageDesc stageDesc();
  bool isStale();
  bool turnSides();
  void compareSides();
  std::array<std::string, 2> sideNames();
  Place place() const;
  void updateStage();
  void updateCoverage();
  void compareWithTruth();
  TruthStatus truthStatus();
  Side side(bool right);
  std::vector<float> cursorValue(bool right, glm::uvec2 texel);
  image::Image pictureOf(const std::string& view);
  void drawWindow();
  void savePicture();
  void saveCapture();
  Status status();
  void writeLayout();

  // Lines of note(), from any thread, that the panel has not shown yet.
  struct Notes {
    std::mutex mutex;
    std::vector<std::string> lines;
  };

  ViewerOptions options_;
  std::shared_ptr<Notes> notes_ = std::make_shared<Notes>();
  std::string stateMessage_;
  ViewerState state_;
  bool setsAside_ = false;  // keepSession() keeps the file that is there under another name
  std::optional<SavedSession> last_;  // the session to begin with
  Session session_;
  Bookmarks bookmarks_;
  WindowLibrary library_;
  InterfaceContext context_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<Screen> screen_;
  std::unique_ptr<Stage> stage_;         // of the session's scene; null before the first
  std::unique_ptr<OtherBackend> other_;  // null: not in use
  std::unique_ptr<SideDifference> difference_;
  std::unique_ptr<TruthView> truth_;
  Panel panel_;
  Controls controls_;
  SceneLoading loading_{WindowLibrary::wake};
  Rebuild rebuild_;
  Portal portal_;
  std::string buildMessage_;
  std::string failedScene_;  // as in Status
  bool pictured_ = false;    // the scene has its thumbnail
  bool keepsLater_ = false;  // the session is kept once the scene's picture is complete
  ChildRun sequence_;
  std::string sequenceText_;  // its last progress
  std::string sequenceFile_;  // that it writes
  TuneRun tune_;
  TuneStatus tuning_;
  PassTimes times_;
  // What a measured coverage depends on.
  struct Measured {
    std::string effect;
    uint64_t values = 0, objects = 0, poses = 0;  // revisions
    const scene::Scene* scene = nullptr;

    bool operator==(const Measured&) const = default;
  };
  std::vector<ColorShare> coverage_;
  Measured measured_;

  std::string backend_, firstBackend_, layoutWritten_;
  double textScale_ = 0;  // of the last frame; 0: no frame yet
  // Size that fitText() gave the window, and the width of the picture that it keeps, in its units.
  glm::uvec2 textSize_ = glm::uvec2(0);
  double textPicture_ = 0;
  int settle_ = 0;            // further frames to draw, for hover and for late updates
  bool moving_ = false;       // a held key or button moves the camera or sprays
  double updateSeconds_ = 0;  // duration of the stage's last update
  // The picture moves: by the camera, until restsAt_, or because the animation plays.
  bool inMotion_ = false;
  Clock::time_point restsAt_ = {};
  // Duration of a frame of the whole resolution, and the number of the last such frames in a row.
  double wholeSeconds_ = 0;
  uint32_t wholeFrames_ = 0;
  bool turned_ = false;  // with SplitWay::kFlicker: the right side is shown
  Clock::time_point turnAt_ = {};
  // How far the sides are apart, and of which content.
  struct Compared {
    std::array<Side, 2> sides;
    uint64_t revision = 0;
    SideNumbers numbers;
  };
  std::optional<Compared> apart_;
  // When a frame that failed is tried again. `wait`: seconds from the failure; 0: none has failed.
  struct Retry {
    double wait = 0;
    Clock::time_point at = {};
  } retry_;
  uint64_t drawn_ = 0;     // frames
  uint32_t complete_ = 0;  // complete frames; see ViewerOptions::frames
  gpu::Texture shown_;     // the window's content in the last frame
  Clock::time_point lastFrame_ = Clock::now(), lastLook_ = Clock::now();
};

}  // namespace grisaille::app::viewer
