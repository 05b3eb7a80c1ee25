// SPDX-License-Identifier: MIT
// Poses a glTF file by the text of the specification, in double precision and without any code of
// the loader: the reference that tests compare the loader with.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace grisaille::scene {

class ReferenceGltf {
 public:
  explicit ReferenceGltf(const std::string& path);

  const nlohmann::json& document() const { return document_; }
  double duration(size_t animation) const;

  // Sets the pose; without an animation, the file's own.
  void pose(std::optional<size_t> animation, double seconds);

  // World from node.
  glm::dmat4 world(size_t node) const;

  // The corners of all triangles, in world space: nodes depth first, then instances, then
  // primitives.
  std::vector<std::vector<glm::dvec3>> corners() const;

 private:
  std::vector<double> accessor(size_t index) const;
  void animate(size_t animation, double seconds);
  std::vector<double> sampled(const nlohmann::json& sampler, double seconds, bool rotation) const;
  glm::dmat4 local(size_t node) const;
  void visit(size_t node, std::vector<std::vector<glm::dvec3>>& to) const;
  std::vector<glm::dvec3> vertices(size_t node, const nlohmann::json& primitive) const;

  nlohmann::json document_;
  std::vector<std::string> buffers_;
  nlohmann::json nodes_;  // as posed
  std::vector<int> parents_;
};

}  // namespace grisaille::scene
