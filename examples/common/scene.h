// SPDX-License-Identifier: MIT
// The scene of both example hosts, a corner of a room with boxes, and functions that write files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace example {

inline constexpr uint32_t kWidth = 320, kHeight = 180;  // pixels
inline constexpr float kNear = 0.1f, kFar = 40;         // metres
inline constexpr float kAngle = 0.9f;                   // vertical angle of view, radians

inline glm::mat4 viewFromWorld() {
  return glm::lookAt(glm::vec3(3.1f, 2.3f, 3.7f), glm::vec3(-0.2f, 0.5f, -0.1f),
                     glm::vec3(0, 1, 0));
}

struct Vertex {
  glm::vec3 position;  // world, metres
  glm::vec3 normal;
};

// Both triangles of a parallelogram, counter-clockwise.
inline void addFace(std::vector<Vertex>& to, glm::vec3 corner, glm::vec3 right, glm::vec3 up) {
  const glm::vec3 normal = glm::normalize(glm::cross(right, up));
  for (const glm::vec2 at : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
    to.push_back({corner + at.x * right + at.y * up, normal});
  }
}

// A box on the floor, turned about y.
inline void addBox(std::vector<Vertex>& to, glm::vec3 middle, glm::vec3 half, float angle) {
  const glm::vec3 x = half.x * glm::vec3(std::cos(angle), 0, -std::sin(angle));
  const glm::vec3 y(0, half.y, 0);
  const glm::vec3 z = half.z * glm::vec3(std::sin(angle), 0, std::cos(angle));
  addFace(to, middle - x - y + z, 2.0f * x, 2.0f * y);
  addFace(to, middle + x - y - z, -2.0f * x, 2.0f * y);
  addFace(to, middle + x - y + z, -2.0f * z, 2.0f * y);
  addFace(to, middle - x - y - z, 2.0f * z, 2.0f * y);
  addFace(to, middle - x + y + z, 2.0f * x, -2.0f * z);
}

inline std::vector<Vertex> scene() {
  std::vector<Vertex> vertices;
  addFace(vertices, {-2, 0, 6}, {8, 0, 0}, {0, 0, -8});
  addFace(vertices, {-2, 0, -2}, {8, 0, 0}, {0, 4, 0});
  addFace(vertices, {-2, 0, 6}, {0, 0, -8}, {0, 4, 0});
  addBox(vertices, {-0.9f, 0.6f, -0.8f}, {0.5f, 0.6f, 0.5f}, 0.4f);
  addBox(vertices, {0.5f, 0.3f, 0.2f}, {0.4f, 0.3f, 0.3f}, -0.5f);
  addBox(vertices, {-0.4f, 0.15f, 0.9f}, {0.15f, 0.15f, 0.6f}, 1.1f);
  addBox(vertices, {1.2f, 0.9f, -1.3f}, {0.3f, 0.9f, 0.3f}, 0.1f);
  return vertices;
}

template <typename T>
void writeFile(const std::filesystem::path& path, const std::vector<T>& content) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(content.data()),
             static_cast<std::streamsize>(content.size() * sizeof(T)));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

// Writes a PPM file of 8 bits per channel. pixels: linear light, rows from the top.
inline void writePicture(const std::filesystem::path& path, const std::vector<glm::vec4>& pixels) {
  std::vector<uint8_t> bytes;
  for (const char c : "P6 " + std::to_string(kWidth) + " " + std::to_string(kHeight) + " 255\n") {
    bytes.push_back(static_cast<uint8_t>(c));
  }
  for (const glm::vec4& pixel : pixels) {
    for (int i = 0; i < 3; ++i) {
      const float encoded = std::pow(glm::clamp(pixel[i], 0.0f, 1.0f), 1 / 2.2f);
      bytes.push_back(static_cast<uint8_t>(encoded * 255 + 0.5f));
    }
  }
  writeFile(path, bytes);
}

}  // namespace example
