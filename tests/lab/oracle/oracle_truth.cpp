// SPDX-License-Identifier: MIT
// Renders ray-traced pictures of a scene: view depth, world normals, ambient visibility.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/trace/ray_tracer.h"

namespace {

using namespace grisaille;

struct Job {
  std::string scene;
  std::string camera;
  glm::uvec2 size = glm::uvec2(0);
  double radius = 0.5;
  uint32_t samples = 256;
  uint32_t seed = 1;
  uint32_t stride = 1;
  std::map<std::string, std::string> outputs;  // name to file
};

glm::uvec2 parseSize(const std::string& text) {
  unsigned width = 0, height = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &end) != 2 || width == 0 ||
      height == 0 || width > 16384 || height > 16384) {
    throw Error(ErrorId::kUsage, "--size {} is not WIDTHxHEIGHT of 1 to 16384 pixels", text);
  }
  return {width, height};
}

Job parseJob(int argc, char** argv) {
  Job job;
  std::string size;
  std::vector<std::string> writes;
  CLI::App app("Ray-traced truth of a scene, by Embree");
  app.add_option("SCENE", job.scene, "glTF file")->required();
  app.add_option("CAMERA", job.camera, "camera file")->required();
  app.add_option("--size", size, "WIDTHxHEIGHT, pixels; default: the camera file's");
  app.add_option("--radius", job.radius, "length of occlusion rays, metres")
      ->check(CLI::PositiveNumber);
  app.add_option("--samples", job.samples, "occlusion rays a pixel")->check(CLI::Range(1, 1 << 20));
  app.add_option("--seed", job.seed, "of the sample points");
  app.add_option("--stride", job.stride, "take each N-th pixel of each N-th row alone")
      ->check(CLI::Range(1, 1024));
  app.add_option("--write", writes, "ao=FILE, error=FILE, depth=FILE or normal=FILE")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  if (!size.empty()) job.size = parseSize(size);
  for (const std::string& text : writes) {
    const size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    if (equals == std::string::npos ||
        (name != "ao" && name != "error" && name != "depth" && name != "normal")) {
      throw Error(ErrorId::kOutputUnknown, "--write {} is not ao, error, depth or normal=FILE",
                  text);
    }
    job.outputs[name] = text.substr(equals + 1);
    image::checkWritable(job.outputs[name]);
  }
  return job;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Traces visibility in parts, to report progress.
std::vector<trace::Visibility> occlude(const trace::RayTracer& tracer,
                                       std::span<const trace::Hit> hits, const Job& job) {
  const auto start = std::chrono::steady_clock::now();
  constexpr size_t kSlice = 65536;
  std::vector<trace::Visibility> all;
  for (size_t begin = 0; begin < hits.size(); begin += kSlice) {
    const auto slice = hits.subspan(begin, std::min(kSlice, hits.size() - begin));
    const auto part = tracer.ambientOcclusion(slice, job.radius, job.samples, job.seed);
    all.insert(all.end(), part.begin(), part.end());
    const double rays = static_cast<double>(all.size()) * job.samples;
    fmt::print(stderr, "\rambient visibility {:3.0f} %, {:.2f} million rays/s",
               100.0 * static_cast<double>(all.size()) / static_cast<double>(hits.size()),
               rays / secondsSince(start) * 1e-6);
  }
  fmt::print(stderr, "\n");
  return all;
}

image::Image errorImage(std::span<const trace::Visibility> values, uint32_t width,
                        uint32_t height) {
  image::Image image{.width = width, .height = height, .channels = 1, .pixels = {}};
  for (const trace::Visibility& value : values) image.pixels.push_back(value.standardError);
  return image;
}

void run(const Job& job) {
  const auto start = std::chrono::steady_clock::now();
  const scene::Scene scene = scene::loadGltf(job.scene);
  const scene::Camera camera = scene::loadCamera(job.camera);
  const glm::uvec2 size = job.size.x != 0 ? job.size : camera.size;
  if (size.x == 0) throw Error(ErrorId::kUsage, "neither --size nor the camera gives a size");
  const trace::RayTracer tracer(scene, camera.eye);
  fmt::print(stderr, "{} triangles ready after {:.2f} s\n", scene::triangleCount(scene),
             secondsSince(start));

  std::vector<glm::uvec2> pixels;
  for (uint32_t y = 0; y < size.y; y += job.stride) {
    for (uint32_t x = 0; x < size.x; x += job.stride) pixels.emplace_back(x, y);
  }
  const uint32_t width = (size.x + job.stride - 1) / job.stride;
  const uint32_t height = (size.y + job.stride - 1) / job.stride;
  const auto hits = tracer.castPrimary(camera, size.x, size.y, pixels);
  std::vector<trace::Visibility> visibility;
  if (job.outputs.contains("ao") || job.outputs.contains("error")) {
    visibility = occlude(tracer, hits, job);
  }
  for (const auto& [name, path] : job.outputs) {
    image::write(name == "depth"    ? trace::depthImage(hits, width, height)
                 : name == "normal" ? trace::normalImage(hits, width, height)
                 : name == "ao"     ? trace::visibilityImage(visibility, width, height)
                                    : errorImage(visibility, width, height),
                 path);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parseJob(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
