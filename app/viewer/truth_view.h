// SPDX-License-Identifier: MIT
// Compares the picture on the screen with the traced truth: traces the view, computes the error,
// and provides truth and error as textures and images.
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
  // The device must outlive this, or its use: see moveTo().
  explicit TruthView(gpu::Device& device) : device_(&device) {}
  ~TruthView();
  TruthView(const TruthView&) = delete;
  TruthView& operator=(const TruthView&) = delete;

  // Uses another device from now on. What is traced stays.
  void moveTo(gpu::Device& device);

  // Sets the view and its compared output. Traces only if the view differs from the last one; else
  // compares the new picture with the truth traced already.
  void show(const truth::LiveView& view, image::Image picture);

  // Traces the same view with another radius (metres) or rays per pixel, if one of them differs.
  // Does nothing without a picture.
  void follow(double radius, uint32_t rays);

  // Ends the tracing and the comparison.
  void stop();

  // True while the view is being traced.
  bool running() const { return running_; }
  uint64_t started() const { return started_; }  // number of truths started

  // Takes new results. True if they must be drawn: the first of a view at once, later ones a few
  // times per second. Throws Error if the scene cannot be traced, and ends the tracing.
  bool look();

  const truth::Comparison& comparison() const { return comparison_; }
  double rays() const { return traced_.rays; }  // mean per traced pixel
  double share() const;                         // traced share of the pixels, 0 ... 1

  // The values at a pixel, or at the traced pixel that stands in for it; none if neither is traced.
  std::optional<truth::Point> at(glm::uvec2 texel) const;

  // The texture of kTruthView or kErrorView; none until every pixel is traced or has a stand-in.
  // Valid until the next call. Call between two frames of the device.
  std::optional<Side> side(std::string_view view);
  uint64_t revision() const { return revision_; }

  // The values of kTruthView or kErrorView. A pixel that is not traced has its stand-in's value,
  // else NaN.
  image::Image numbers(std::string_view view) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Sheet {
    gpu::Texture texture;
    glm::uvec2 size = glm::uvec2(0);
    uint64_t revision = 0;  // of its content
  };

  void restart();
  void compare();
  std::optional<size_t> standIn(glm::uvec2 texel) const;

  gpu::Device* device_;
  truth::LiveTruth truth_;
  truth::LiveView view_;
  image::Image picture_;  // without pixels: no comparison
  truth::Traced traced_;
  truth::Comparison comparison_;
  Clock::time_point looked_{};
  uint64_t started_ = 0;
  bool running_ = false;
  std::array<Sheet, 2> sheets_;  // truth, error
  uint64_t revision_ = 1;
};

}  // namespace grisaille::app::viewer
