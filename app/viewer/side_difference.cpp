// SPDX-License-Identifier: MIT
#include "app/viewer/side_difference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "shaders/difference.h"

namespace grisaille::app::viewer {
namespace {

constexpr uint32_t kSquare = 64;  // pixels a side that one group sums; same as in difference.comp

// Same layout as in shaders/viewer/difference.comp.
struct DifferenceBlock {
  uint32_t channels;
};
GRISAILLE_CHECK_BLOCK_difference_Difference(DifferenceBlock);

uint32_t channelsOf(Kind kind) {
  return kind == Kind::kNumber || kind == Kind::kDepth ? 1 : kind == Kind::kOverlay ? 4 : 3;
}

}  // namespace

SideDifference::~SideDifference() {
  device_.destroy(pipeline_);
  device_.destroy(nearest_);
  device_.destroy(sums_);
}

SideNumbers SideDifference::compare(const std::array<Side, 2>& sides, glm::uvec2 size) {
  const glm::uvec2 groups = (size + (kSquare - 1)) / kSquare;
  const uint64_t count = uint64_t{groups.x} * groups.y;
  if (count == 0) return {};
  if (!pipeline_) {
    nearest_ = device_.createSampler({.label = "nearest"});
    pipeline_ = device_.createComputePipeline(
        {.label = "difference", .shader = &grisaille_shader_difference, .constants = {}});
  }
  if (groups_ < count) {
    device_.destroy(sums_);
    sums_ = {};
    groups_ = 0;  // in case no buffer can be created
    sums_ = device_.createBuffer(
        {.label = "sums", .size = count * sizeof(glm::vec4), .usage = gpu::BufferUsage::kStorage});
    groups_ = count;
  }
  const DifferenceBlock block = {channelsOf(sides[0].kind)};
  gpu::Commands& commands = device_.begin();
  try {
    const std::array bindings = {
        gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(&block, 1)))),
        gpu::textureBinding(0, {.texture = sides[0].texture}, nearest_),
        gpu::textureBinding(1, {.texture = sides[1].texture}, nearest_),
        gpu::storageBinding(0, {sums_})};
    commands.beginPass("viewer/difference");
    commands.dispatch(
        {.pipeline = pipeline_, .bindings = bindings, .groups = {groups.x, groups.y, 1}});
    commands.endPass();
    device_.submit();
  } catch (...) {
    device_.abandon();
    throw;
  }
  const std::vector<std::byte> bytes =
      device_.read(gpu::BufferRange{sums_, 0, count * sizeof(glm::vec4)});
  SideNumbers numbers;
  double squares = 0;
  for (uint64_t i = 0; i < count; ++i) {
    glm::vec4 sum;
    std::memcpy(&sum, &bytes[i * sizeof(sum)], sizeof(sum));
    squares += double{sum.x};
    numbers.compared += static_cast<uint64_t>(sum.y);
    numbers.largest = std::max(numbers.largest, double{sum.z});
  }
  if (numbers.compared > 0) {
    numbers.rmse = std::sqrt(squares / static_cast<double>(numbers.compared));
  }
  return numbers;
}

}  // namespace grisaille::app::viewer
