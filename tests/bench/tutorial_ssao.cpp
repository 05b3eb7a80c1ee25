// SPDX-License-Identifier: MIT
#include "tests/bench/tutorial_ssao.h"

#include <random>
#include <vector>

#include "core/frame/texture_image.h"
#include "core/scene/view.h"
#include "shaders/tutorial_blur.h"
#include "shaders/tutorial_inputs.h"
#include "shaders/tutorial_occlusion.h"
#include "shaders/tutorial_screen.h"

namespace grisaille::bench {
namespace {

constexpr gpu::Format kInputFormat = gpu::Format::kRgba16Float;
constexpr gpu::Format kOutputFormat = gpu::Format::kR8Unorm;
constexpr uint32_t kNoiseSize = 4;  // texels per side

struct InputsBlock {
  glm::mat4 rotation;
  glm::vec4 tangents;
};
GRISAILLE_CHECK_BLOCK_tutorial_inputs_Inputs(InputsBlock);

struct TutorialBlock {
  glm::mat4 projection;
  std::array<glm::vec4, 64> kernel;
  glm::vec4 repeats_lengths;
};
GRISAILLE_CHECK_BLOCK_tutorial_occlusion_Tutorial(TutorialBlock);

// Uniform in [0, 1), taken from the engine's bits. These are the same on every platform; the
// standard's distributions are not.
class Random {
 public:
  float next() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }

 private:
  std::mt19937 engine_{1};
};

gpu::TextureDesc targetDesc(std::string_view label, gpu::Format format, uint32_t width,
                            uint32_t height) {
  return {.label = label,
          .format = format,
          .width = width,
          .height = height,
          .usage = gpu::TextureUsage::kTarget | gpu::TextureUsage::kSampled};
}

template <typename Block>
gpu::BufferRange uniformOf(gpu::Commands& commands, const Block& block) {
  return commands.uniform(std::as_bytes(std::span(&block, 1)));
}

}  // namespace

TutorialSsao::TutorialSsao(gpu::Device& device) : device_(device) {
  Random random;
  for (size_t i = 0; i < kernel_.size(); ++i) {
    const float x = 2 * random.next() - 1;
    const float y = 2 * random.next() - 1;
    const glm::vec3 direction = glm::normalize(glm::vec3(x, y, random.next() + 1e-6f));
    const float along = static_cast<float>(i) / static_cast<float>(kernel_.size());
    const float scale = glm::mix(0.1f, 1.0f, along * along);
    kernel_[i] = glm::vec4(direction * random.next() * scale, 0);
  }
  std::vector<glm::vec4> rotations;
  for (uint32_t i = 0; i < kNoiseSize * kNoiseSize; ++i) {
    const float x = 2 * random.next() - 1;
    rotations.emplace_back(x, 2 * random.next() - 1, 0, 0);
  }
  noise_ = device_.createTexture({.label = "tutorial noise",
                                  .format = gpu::Format::kRgba32Float,
                                  .width = kNoiseSize,
                                  .height = kNoiseSize,
                                  .usage = gpu::TextureUsage::kSampled});
  clamped_ = device_.createSampler({.label = "tutorial clamped"});
  repeated_ = device_.createSampler({.label = "tutorial repeated",
                                     .addressU = gpu::Address::kRepeat,
                                     .addressV = gpu::Address::kRepeat});
  const std::array inputFormats = {kInputFormat, kInputFormat};
  const std::array outputFormats = {kOutputFormat};
  inputs_ = pipeline("tutorial inputs", grisaille_shader_tutorial_inputs, inputFormats);
  occlusion_ = pipeline("tutorial occlusion", grisaille_shader_tutorial_occlusion, outputFormats);
  blur_ = pipeline("tutorial blur", grisaille_shader_tutorial_blur, outputFormats);
  device_.begin().upload(noise_, 0, 0, std::as_bytes(std::span(rotations)));
  device_.submit();
}

TutorialSsao::~TutorialSsao() {
  device_.destroy(blur_);
  device_.destroy(occlusion_);
  device_.destroy(inputs_);
  device_.destroy(repeated_);
  device_.destroy(clamped_);
  device_.destroy(output_);
  device_.destroy(noise_);
}

gpu::GraphicsPipeline TutorialSsao::pipeline(std::string_view label, const gpu::Shader& fragment,
                                             std::span<const gpu::Format> formats) {
  return device_.createGraphicsPipeline({.label = label,
                                         .vertex = &grisaille_shader_tutorial_screen,
                                         .fragment = &fragment,
                                         .colorFormats = formats});
}

void TutorialSsao::pass(gpu::Commands& commands, std::string_view label,
                        gpu::GraphicsPipeline pipeline, std::span<const gpu::Binding> bindings,
                        std::span<const gpu::Texture> targets) {
  std::vector<gpu::ColorTarget> colors;
  for (const gpu::Texture texture : targets) {
    colors.push_back({.view = {.texture = texture}, .load = gpu::Load::kDiscard});
  }
  const gpu::Draw draw = {.pipeline = pipeline, .bindings = bindings, .count = 3};
  commands.beginPass(label);
  commands.render({.colors = colors, .draws = std::span(&draw, 1)});
  commands.endPass();
}

void TutorialSsao::draw(frame::Renderer& renderer, const scene::Camera& camera, glm::uvec2 size,
                        double radius) {
  const glm::mat4 projection(scene::clipFromView(scene::viewOf(camera, size)));
  const glm::mat3 viewFromWorld(glm::transpose(scene::worldFromView(camera)));
  gpu::Commands& commands = device_.begin();
  const Inputs inputs = makeInputs(commands, renderer.texture("depth"), renderer.texture("normal"),
                                   projection, viewFromWorld, size.x, size.y);
  record(commands, inputs.position, inputs.normal, projection, size.x, size.y, radius);
  device_.submit();
}

image::Image TutorialSsao::read() {
  return frame::toImage(device_.read(output_), gpu::Format::kR8Unorm, outputSize_.x, outputSize_.y);
}

TutorialSsao::Inputs TutorialSsao::makeInputs(gpu::Commands& commands, gpu::Texture viewDepth,
                                              gpu::Texture worldNormal, const glm::mat4& projection,
                                              const glm::mat3& viewFromWorld, uint32_t width,
                                              uint32_t height) {
  const Inputs inputs = {
      .position = commands.transient(targetDesc("tutorial position", kInputFormat, width, height)),
      .normal = commands.transient(targetDesc("tutorial normal", kInputFormat, width, height))};
  const InputsBlock block = {
      .rotation = glm::mat4(viewFromWorld),
      .tangents = glm::vec4(1 / projection[0][0], 1 / projection[1][1], 0, 0)};
  const std::array bindings = {gpu::uniformBinding(0, uniformOf(commands, block)),
                               gpu::textureBinding(0, {.texture = viewDepth}, clamped_),
                               gpu::textureBinding(1, {.texture = worldNormal}, clamped_)};
  const std::array targets = {inputs.position, inputs.normal};
  pass(commands, "inputs_of_tutorial", inputs_, bindings, targets);
  return inputs;
}

void TutorialSsao::record(gpu::Commands& commands, gpu::Texture position, gpu::Texture normal,
                          const glm::mat4& projection, uint32_t width, uint32_t height,
                          double radius) {
  glm::mat4 downwards = projection;
  for (int column = 0; column < 4; ++column) downwards[column][1] = -projection[column][1];
  const TutorialBlock block = {
      .projection = downwards,
      .kernel = kernel_,
      .repeats_lengths = glm::vec4(glm::vec2(width, height) / static_cast<float>(kNoiseSize),
                                   radius, radius / 20)};
  const std::array bindings = {gpu::uniformBinding(0, uniformOf(commands, block)),
                               gpu::textureBinding(0, {.texture = position}, clamped_),
                               gpu::textureBinding(1, {.texture = normal}, clamped_),
                               gpu::textureBinding(2, {.texture = noise_}, repeated_)};
  const gpu::Texture raw =
      commands.transient(targetDesc("tutorial visibility", kOutputFormat, width, height));
  pass(commands, "tutorial_occlusion", occlusion_, bindings, std::span(&raw, 1));

  if (outputSize_ != glm::uvec2(width, height)) {
    device_.destroy(output_);
    output_ = device_.createTexture(targetDesc("tutorial blurred", kOutputFormat, width, height));
    outputSize_ = glm::uvec2(width, height);
  }
  const std::array blurBindings = {gpu::textureBinding(0, {.texture = raw}, clamped_)};
  pass(commands, "tutorial_blur", blur_, blurBindings, std::span(&output_, 1));
}

}  // namespace grisaille::bench
