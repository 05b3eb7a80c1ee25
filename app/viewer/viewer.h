// SPDX-License-Identifier: MIT
// The viewer: a window, what it shows, and the loop that draws when there is something to draw.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "app/viewer/controls.h"
#include "app/viewer/rebuild.h"
#include "app/viewer/scene_loading.h"
#include "app/viewer/screen.h"
#include "app/viewer/truth_view.h"
#include "app/viewer/window.h"

namespace grisaille::app::viewer {

struct ViewerOptions {
  SessionOptions session;
  std::string backend, device;      // "": whatever starts
  std::string bookmarks;            // a folder; "": configFolder()/bookmarks
  std::string layoutFile;           // where the controls' places are written; "": nowhere
  glm::uvec2 size = glm::uvec2(0);  // of the window; 0: as it was left
  // Ends after so many frames with the scene's picture and, where it is compared with the truth,
  // the whole of that; 0: when it is closed.
  uint32_t frames = 0;
  std::string capture;  // what the window holds at the end, .png or .exr; "": nowhere
  bool check = false;
  gpu::MessageSink message = {};  // what the driver says; none: standard error
};

class Viewer {
 public:
  // Opens the window. Throws Error.
  explicit Viewer(const ViewerOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // Until the window is closed. Where it ends otherwise, by an error or a signal, what the user has
  // not saved is written to a folder first. Throws Error and truth::Interrupted.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // viewer.cpp
  void showFrames();
  void rescue();
  void openWindow();
  void tryBackend(const backends::Backend& backend);
  double patience();
  bool lookAround();
  void frame(double seconds);
  void perform(const Requests& requests);
  void startTune(const TuneWish& wish);
  bool lookAtTune();
  void openScene(const std::string& path);
  void takeScene();
  void takeDropped();
  void nameWindow();
  void keepState();
  // viewer_picture.cpp
  StageDesc stageDesc();
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

  ViewerOptions options_;
  std::string stateMessage_;
  ViewerState state_;
  Session session_;
  Bookmarks bookmarks_;
  WindowLibrary library_;
  InterfaceContext context_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<Screen> screen_;
  std::unique_ptr<Stage> stage_;  // of the session's scene
  std::unique_ptr<TruthView> truth_;
  Panel panel_;
  Controls controls_;
  SceneLoading loading_;
  Rebuild rebuild_;
  std::string buildMessage_;
  TuneRun tune_;
  TuneStatus tuning_;
  PassTimes times_;
  std::vector<ColorShare> coverage_;

  std::string backend_, layoutWritten_;
  int settle_ = 0;            // frames still to be drawn, for what hovers and follows
  bool moving_ = false;       // something moves by itself
  double updateSeconds_ = 0;  // of the stage's last update
  uint64_t drawn_ = 0;        // frames
  uint32_t complete_ = 0;     // frames with the scene's picture
  gpu::Texture shown_;        // of the last frame
  Clock::time_point lastFrame_ = Clock::now(), lastLook_ = Clock::now();
};

}  // namespace grisaille::app::viewer
