// SPDX-License-Identifier: MIT
// The JSON of a glTF file before tinygltf parses it: its extensions, and what tinygltf cannot read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace grisaille::scene {

// Throws kSceneExtension for a required extension that may change geometry, alpha or base colour
// and that the loader does not read. Adds one note that names all used extensions which it leaves
// out.
void checkExtensions(const nlohmann::json& document, std::vector<std::string>& notes);

// Rewrites valid glTF that tinygltf refuses. undo() restores the parsed model.
class Adaptation {
 public:
  // Changes the document. Returns false if tinygltf reads it as it is.
  bool apply(nlohmann::json& document);
  void undo(tinygltf::Model& model) const;

 private:
  void giveViews(nlohmann::json& document);
  void giveNodes(nlohmann::json& document);
  void giveInverseBinds(nlohmann::json& document);
  void emptyFallbacks(nlohmann::json& document);

  bool changed_ = false;
  bool addedView_ = false;
  std::vector<size_t> viewless_;  // accessors of indices without a buffer view
};

}  // namespace grisaille::scene
