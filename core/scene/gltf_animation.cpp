// SPDX-License-Identifier: MIT
#include <tiny_gltf.h>

#include <algorithm>
#include <tuple>

#include "core/base/error.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_deformed.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

namespace grisaille::scene {
namespace {

class AnimationReader {
 public:
  AnimationReader(const tinygltf::Model& model, const Rig& rig, std::vector<std::string>& notes)
      : model_(model), rig_(rig), notes_(notes) {}

  Animation read(size_t index) {
    const tinygltf::Animation& from = model_.animations[index];
    Animation result{.name = from.name, .keys = {}, .channels = {}};
    known_.clear();
    leftOut_ = 0;
    for (size_t i = 0; i < from.channels.size(); ++i) {
      inPlace(fmt::format("animations[{}].channels[{}]", index, i),
              [&] { addChannel(from, from.channels[i], result); });
    }
    if (leftOut_ > 0) {
      notes_.push_back(fmt::format(
          "animations[{}]: {} channels left out: their nodes have a matrix, or no morph targets",
          index, leftOut_));
    }
    for (const Keys& keys : result.keys) {
      result.duration = std::max(result.duration, double{keys.seconds.back()});
    }
    return result;
  }

 private:
  void addChannel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& from,
                  Animation& to) {
    constexpr std::pair<std::string_view, Moved> kPaths[] = {{"translation", Moved::kTranslation},
                                                             {"rotation", Moved::kRotation},
                                                             {"scale", Moved::kScale},
                                                             {"weights", Moved::kWeights}};
    const auto path =
        std::ranges::find(kPaths, from.target_path, &std::pair<std::string_view, Moved>::first);
    if (from.target_node == -1 || path == std::end(kPaths)) return;
    if (from.target_node < 0 || static_cast<size_t>(from.target_node) >= model_.nodes.size()) {
      throw Error(ErrorId::kSceneInvalid, "target.node: node {} does not exist", from.target_node);
    }
    Channel channel{.node = static_cast<uint32_t>(from.target_node), .moved = path->second};
    uint32_t width = channel.moved == Moved::kRotation ? 4 : 3;
    if (channel.moved == Moved::kWeights) {
      const int mesh = model_.nodes[channel.node].mesh;
      width = static_cast<uint32_t>(targetCount(model_, mesh));
      if (width == 0) {
        ++leftOut_;
        return;
      }
    } else if (rig_.nodes[channel.node].matrix) {
      ++leftOut_;
      return;
    }
    if (from.sampler < 0 || static_cast<size_t>(from.sampler) >= animation.samplers.size()) {
      throw Error(ErrorId::kSceneInvalid, "sampler {} does not exist", from.sampler);
    }
    const auto [found, isNew] =
        known_.try_emplace({from.sampler, channel.moved, width}, to.keys.size());
    if (isNew) {
      to.keys.push_back(inPlace(fmt::format("sampler {}", from.sampler), [&] {
        return keysOf(animation.samplers[static_cast<size_t>(from.sampler)], channel.moved, width);
      }));
    }
    channel.keys = static_cast<uint32_t>(found->second);
    to.channels.push_back(channel);
  }

  Keys keysOf(const tinygltf::AnimationSampler& from, Moved moved, uint32_t width) {
    Keys keys{.width = width, .seconds = {}, .values = {}};
    if (from.interpolation == "STEP") {
      keys.interpolation = Interpolation::kStep;
    } else if (from.interpolation == "CUBICSPLINE") {
      keys.interpolation = Interpolation::kCubicSpline;
    } else if (from.interpolation != "LINEAR" && !from.interpolation.empty()) {
      throw Error(ErrorId::kSceneInvalid,
                  "interpolation is \"{}\"; allowed are LINEAR, STEP and CUBICSPLINE",
                  oneLine(from.interpolation));
    }
    const uint64_t count = inPlace("input", [&] { return accessorCount(model_, from.input); });
    const uint64_t given = inPlace("output", [&] { return accessorCount(model_, from.output); });
    const uint64_t perKey = (keys.interpolation == Interpolation::kCubicSpline ? 3u : 1u) *
                            (moved == Moved::kWeights ? uint64_t{width} : uint64_t{1});
    if (count == 0 || given / perKey != count || given % perKey != 0) {
      throw Error(ErrorId::kSceneInvalid, "output has {} elements for {} times of {}", given, count,
                  perKey);
    }
    values_ += count + given * (moved == Moved::kWeights ? 1u : width);
    if (values_ > kMaxKeyValues) {
      throw Error(ErrorId::kSceneTooLarge, "the animations have more than {} numbers",
                  kMaxKeyValues);
    }
    keys.seconds = inPlace("input", [&] { return readScalars(model_, from.input); });
    const auto descent = std::ranges::is_sorted_until(keys.seconds);
    if (descent != keys.seconds.end()) {
      throw Error(ErrorId::kSceneInvalid, "input: {} s follows {} s; times must ascend", *descent,
                  *(descent - 1));
    }
    inPlace("output", [&] { keys.values = valuesOf(from.output, moved); });
    return keys;
  }

  std::vector<float> valuesOf(int accessor, Moved moved) {
    if (moved == Moved::kWeights) return readScalars(model_, accessor);
    std::vector<float> values;
    const auto append = [&](const auto& vectors) {
      for (const auto& v : vectors) {
        for (int c = 0; c < v.length(); ++c) values.push_back(v[c]);
      }
    };
    if (moved == Moved::kRotation) {
      append(readVec4(model_, accessor));
    } else {
      append(readVec3(model_, accessor));
    }
    return values;
  }

  const tinygltf::Model& model_;
  const Rig& rig_;
  std::vector<std::string>& notes_;
  std::map<std::tuple<int, Moved, uint32_t>, size_t> known_;  // of one animation
  size_t leftOut_ = 0;                                        // channels of one animation
  uint64_t values_ = 0;                                       // of all
};

}  // namespace

std::vector<Animation> readAnimations(const tinygltf::Model& model, const Rig& rig,
                                      std::vector<std::string>& notes) {
  AnimationReader reader(model, rig, notes);
  std::vector<Animation> result;
  for (size_t i = 0; i < model.animations.size(); ++i) result.push_back(reader.read(i));
  return result;
}

}  // namespace grisaille::scene
