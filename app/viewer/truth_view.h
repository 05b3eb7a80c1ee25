// SPDX-License-Identifier: MIT
// The picture on the screen beside its truth: what is traced, how far apart the two are, and both
// as pictures.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

#include "app/truth/comparison.h"
#include "app/truth/live_truth.h"
#include "app/viewer/screen.h"

namespace grisaille::app::viewer {

class TruthView {
 public:
  // The device outlives this.
  explicit TruthView(gpu::Device& device) : device_(device) {}
  ~TruthView();
  TruthView(const TruthView&) = delete;
  TruthView& operator=(const TruthView&) = delete;

  // What is on the screen: the compared output of a view. Only another view is traced anew: another
  // picture of the same one is compared with the truth that there is.
  void show(const truth::LiveView& view, image::Image picture);

  // The same picture, compared with another truth. Nothing happens where there is none.
  void follow(double radius, uint32_t rays);

  // Nothing is compared any more.
  void stop();

  // Whether look() will have more to tell.
  bool running() const { return running_; }
  uint64_t started() const { return started_; }  // how many truths so far

  // True where there is something new to be drawn: at once for the first of a view, then some times
  // a second. Throws Error where the scene cannot be traced; then nothing is compared.
  bool look();

  const truth::Comparison& comparison() const { return comparison_; }
  double rays() const { return traced_.rays; }  // a traced pixel, on average
  double share() const;                         // of the picture's pixels that are traced

  // Of one pixel, or of the one that stands for it.
  std::optional<truth::Point> at(glm::uvec2 texel) const;

  // kTruthView or kErrorView as the screen shows it; none until there is something for every pixel.
  // Valid until the next call. Between two frames of the device.
  std::optional<Side> side(std::string_view view);
  uint64_t revision() const { return revision_; }

  // The same as numbers; where a pixel is not traced, another may stand for it, else NaN.
  image::Image numbers(std::string_view view) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Sheet {
    gpu::Texture texture;
    glm::uvec2 size = glm::uvec2(0);
    uint64_t revision = 0;  // of what it holds
  };

  void restart();
  void compare();
  std::optional<size_t> standIn(glm::uvec2 texel) const;

  gpu::Device& device_;
  truth::LiveTruth truth_;
  truth::LiveView view_;
  image::Image picture_;  // without pixels: nothing is compared
  truth::Traced traced_;
  truth::Comparison comparison_;
  Clock::time_point looked_{};
  uint64_t started_ = 0;
  bool running_ = false;
  std::array<Sheet, 2> sheets_;  // truth, error
  uint64_t revision_ = 1;
};

}  // namespace grisaille::app::viewer
