// SPDX-License-Identifier: MIT
// vulkan_host OUTPUT_FOLDER [--check]: draws five frames and writes the last one as picture.ppm.
// Also writes raw numbers, rows from the top: depth.f32 (reversed depth buffer), normal.f16 (four
// components, world space), ao.f16, and vertices.f32 (of the scene: position and normal). --check
// fails if the validation layer reports an error or a warning.
#include <cstdio>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string_view>

// grisaille: begin
#include <grisaille/host.hpp>
// grisaille: end

#include "renderer.h"
#include "scene.h"

namespace example {
namespace {

// grisaille: begin
namespace gr = grisaille::host;

// Ambient occlusion of the renderer's scene.
class Occlusion {
 public:
  Occlusion(const Context& context, const Renderer& renderer)
      : device_(gr::Device::vulkan({.instance = context.instance,
                                    .physicalDevice = context.physical,
                                    .device = context.device,
                                    .queueFamily = context.family,
                                    .framesInFlight = Renderer::kFramesInFlight,
                                    .getInstanceProcAddr = loaderEntry()})),
        depth_(wrap(renderer.depth)),
        normal_(wrap(renderer.normal)),
        effect_(device_, {.effect = "ssao", .width = kWidth, .height = kHeight}),
        camera_(&viewFromWorld()[0][0], &clipFromView()[0][0]) {
    effect_.set("radius", 0.5);
  }

  void record(VkCommandBuffer commands, uint64_t frame) {
    effect_.record({.number = frame,
                    .commandBuffer = commands,
                    .camera = camera_,
                    .depth = depth_,
                    .normal = &normal_});
  }

  grisaille_host_output output() const { return effect_.output("ao"); }

 private:
  // Entry point of the loader that this program uses, which may be another than libvulkan.so.1.
  static void (*loaderEntry())() { return reinterpret_cast<void (*)()>(vkGetInstanceProcAddr); }

  gr::Texture wrap(const Image& image) const {
    return {device_,
            {.image = gr::number(image.image),
             .format = static_cast<uint32_t>(image.format),
             .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
             .width = kWidth,
             .height = kHeight}};
  }

  gr::Device device_;
  gr::Texture depth_, normal_;
  gr::Effect effect_;
  gr::Camera camera_;
};
// grisaille: end

void write(const std::filesystem::path& folder, Renderer& renderer, VkImage visibility,
           VkImageLayout visibilityLayout) {
  const auto read = [&](const Image& image, VkImageLayout layout, uint32_t bytes) {
    return renderer.read(image.image, image.aspect, layout, bytes);
  };
  constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  writeFile(folder / "depth.f32", read(renderer.depth, kRead, 4));
  writeFile(folder / "normal.f16", read(renderer.normal, kRead, 8));
  writeFile(folder / "ao.f16",
            renderer.read(visibility, VK_IMAGE_ASPECT_COLOR_BIT, visibilityLayout, 2));
  const std::vector<std::byte> halves = read(renderer.colour, VK_IMAGE_LAYOUT_GENERAL, 8);
  std::vector<glm::vec4> pixels(halves.size() / 8);
  for (size_t i = 0; i < pixels.size(); ++i) {
    uint64_t packed = 0;
    std::memcpy(&packed, &halves[8 * i], sizeof(packed));
    pixels[i] = glm::unpackHalf4x16(packed);
  }
  writePicture(folder / "picture.ppm", pixels);
  writeFile(folder / "vertices.f32", scene());
}

void run(const std::filesystem::path& folder, bool validate) {
  Context context(validate);
  {
    Renderer renderer(context);
    // grisaille: begin
    Occlusion occlusion(context, renderer);
    // grisaille: end
    for (uint64_t frame = 0; frame < 5; ++frame) {
      const VkCommandBuffer commands = renderer.begin(frame);
      renderer.drawScene(commands);
      // grisaille: begin
      occlusion.record(commands, frame);
      const grisaille_host_output visibility = occlusion.output();
      renderer.light(commands, reinterpret_cast<VkImageView>(visibility.view),
                     static_cast<VkImageLayout>(visibility.layout));
      // grisaille: end
      renderer.submit();
    }
    // grisaille: begin
    const grisaille_host_output visibility = occlusion.output();
    // grisaille: end
    write(folder, renderer, reinterpret_cast<VkImage>(visibility.image),
          static_cast<VkImageLayout>(visibility.layout));
  }
  if (context.complaints > 0)
    throw std::runtime_error("the validation layer reports errors or warnings");
}

}  // namespace
}  // namespace example

int main(int count, char** arguments) {
  try {
    if (count < 2) throw std::runtime_error("usage: vulkan_host OUTPUT_FOLDER [--check]");
    example::run(arguments[1], count > 2 && std::string_view(arguments[2]) == "--check");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
