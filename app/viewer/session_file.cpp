// SPDX-License-Identifier: MIT
#include "app/viewer/session_file.h"

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"
#include "core/scene/built_in.h"
#include "core/scene/camera_json.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kMark = "grisaille_session";  // the first member; its value is the version
constexpr int kVersion = 1;
constexpr uintmax_t kLargestSession = uintmax_t{1} << 30;
constexpr double kLongestTime = 1e9;  // seconds
constexpr std::array kWays = {"line", "difference", "flicker"};

[[noreturn]] void refuseSession(std::string_view why) {
  throw Error(ErrorId::kSessionFile, "{}", why);
}

// Calls `read` with a member of an object if it is there.
template <typename Read>
void with(const json& object, const char* key, Read&& read) {
  const auto found = object.find(key);
  if (found != object.end() && !found->is_null()) read(*found);
}

void take(const json& object, const char* key, double& number, double least, double most) {
  with(object, key, [&](const json& value) {
    const double given = value.is_number() ? value.get<double>() : NAN;
    if (!(given >= least && given <= most)) {
      refuseSession(fmt::format("'{}' is not a number from {:g} to {:g}", key, least, most));
    }
    number = given;
  });
}

void take(const json& object, const char* key, float& number, double least, double most) {
  double wide = double{number};
  take(object, key, wide, least, most);
  number = static_cast<float>(wide);
}

void take(const json& object, const char* key, bool& flag) {
  with(object, key, [&](const json& value) {
    if (!value.is_boolean()) refuseSession(fmt::format("'{}' is neither true nor false", key));
    flag = value.get<bool>();
  });
}

void take(const json& object, const char* key, std::string& text) {
  with(object, key, [&](const json& value) {
    if (!value.is_string()) refuseSession(fmt::format("'{}' is not a text", key));
    text = value.get<std::string>();
  });
}

// Calls `read` with a member that must be an object.
template <typename Read>
void within(const json& object, const char* key, Read&& read) {
  with(object, key, [&](const json& value) {
    if (!value.is_object()) refuseSession(fmt::format("'{}' is not an object", key));
    read(value);
  });
}

effect::Selection::State stateOf(const json& list, const char* key) {
  effect::Selection::State state;
  if (!list.is_array()) refuseSession(fmt::format("'{}' is not an array", key));
  for (const json& one : list) {
    if (!one.is_object()) refuseSession(fmt::format("'{}' holds something else than objects", key));
    effect::Selection::State::One& entry = state.effects.emplace_back();
    take(one, "key", entry.key);
    take(one, "on", entry.on);
    within(one, "values", [&](const json& values) {
      for (const auto& [name, value] : values.items()) {
        if (!value.is_string())
          refuseSession(fmt::format("value '{}' is not a text", oneLine(name)));
        entry.values.emplace_back(name, value.get<std::string>());
      }
    });
  }
  return state;
}

ordered_json jsonOf(const effect::Selection::State& state) {
  ordered_json list = ordered_json::array();
  for (const effect::Selection::State::One& one : state.effects) {
    ordered_json values = ordered_json::object();
    for (const auto& [key, text] : one.values) values[key] = text;
    list.push_back({{"key", one.key}, {"on", one.on}, {"values", values}});
  }
  return list;
}

// A scene that has moved together with the session file.
std::string placeOf(const std::string& scene, const std::string& beside, const fs::path& folder) {
  std::error_code failed;
  const bool there = scene::findBuiltIn(scene) != nullptr || fs::exists(scene, failed);
  if (there || beside.empty() || fs::path(beside).is_absolute()) return scene;
  const fs::path moved = fs::absolute(folder / beside, failed).lexically_normal();
  return !failed && fs::exists(moved, failed) ? moved.string() : scene;
}

void takeView(const json& view, SavedSession& session) {
  take(view, "surface", session.surface);
  if (session.surface != "white" && session.surface != "base") {
    refuseSession("'surface' is neither white nor base");
  }
  take(view, "background", session.background);
  take(view, "left", session.left);
  take(view, "right", session.right);
  take(view, "split", session.split);
  take(view, "line", session.line, 0, 1);
  take(view, "inspecting", session.inspecting);
  std::string way = kWays[0];
  take(view, "compare_by", way);
  const auto found = std::ranges::find(kWays, std::string_view(way));
  if (found == kWays.end()) refuseSession("'compare_by' is none of line, difference and flicker");
  session.splitting.way = static_cast<SplitWay>(found - kWays.begin());
  using S = SplitSettings;
  take(view, "full_colour", session.splitting.full, double{S::kLeastFull}, double{S::kMostFull});
  take(view, "turn_seconds", session.splitting.turn, S::kLeastTurn, S::kMostTurn);
  take(view, "right_backend", session.splitting.backend);
  take(view, "halves_while_moving", session.fineness.halves);
  take(view, "converges_at_rest", session.fineness.converges);
}

void takeTruth(const json& truth, TruthSettings& comparing) {
  take(truth, "on", comparing.on);
  take(truth, "output", comparing.output);
  double radius = 0, rays = comparing.rays;
  take(truth, "radius", radius, 0, TruthSettings::kFarthest);
  if (radius > 0) comparing.radius = radius;
  take(truth, "rays", rays, TruthSettings::kLeastRays, TruthSettings::kMostRays);
  comparing.rays = static_cast<uint32_t>(rays);
}

void takeSequence(const json& object, Sequence& sequence) {
  with(object, "cameras", [&](const json& list) {
    if (!list.is_array() || list.size() > Sequence::kMostKeys) {
      refuseSession(fmt::format("'cameras' is not an array of at most {}", Sequence::kMostKeys));
    }
    for (const json& camera : list) {
      if (!camera.is_object()) refuseSession("'cameras' holds something else than objects");
      sequence.keys.push_back(scene::cameraFromJson(camera, "sequence"));
    }
  });
  take(object, "seconds", sequence.seconds, Sequence::kShortest, Sequence::kLongest);
  take(object, "with_animation", sequence.animated);
  take(object, "files", sequence.file);
  take(object, "video", sequence.video);
  take(object, "makes_video", sequence.filmed);
}

ordered_json jsonOf(const Sequence& sequence) {
  ordered_json cameras = ordered_json::array();
  for (const scene::Camera& camera : sequence.keys) {
    cameras.push_back(ordered_json::parse(scene::cameraJson(camera)));
  }
  return {{"cameras", cameras},
          {"seconds", sequence.seconds},
          {"with_animation", sequence.animated},
          {"files", sequence.file},
          {"video", sequence.video},
          {"makes_video", sequence.filmed}};
}

PanelLayout layoutOf(const json& layout) {
  PanelLayout panel;
  take(layout, "light", panel.light);
  take(layout, "text_scale", panel.textScale, PanelLayout::kSmallestText,
       PanelLayout::kLargestText);
  take(layout, "panel_width", panel.panelWidth, PanelLayout::kNarrowest, PanelLayout::kWidest);
  within(layout, "sections", [&](const json& sections) {
    if (sections.size() > PanelLayout::kMostSections)
      refuseSession("'sections' has too many members");
    for (const auto& [name, open] : sections.items()) {
      if (!open.is_boolean()) refuseSession("'sections' holds something else than true and false");
      panel.sections[name] = open.get<bool>();
    }
  });
  return panel;
}

SavedSession sessionOf(const json& document, const fs::path& folder) {
  if (!document.is_object() || !document.contains(kMark)) refuseSession("it is not a session");
  if (document[kMark] != kVersion) {
    refuseSession(
        fmt::format("its version is {}, not {}", oneLine(document[kMark].dump()), kVersion));
  }
  SavedSession session;
  std::string beside;
  take(document, "scene", session.scene);
  take(document, "scene_beside", beside);
  session.scene = placeOf(session.scene, beside, folder);
  within(document, "pose", [&](const json& pose) {
    double animation = 0;
    take(pose, "animation", animation, 0, 1e6);
    session.pose.animation = static_cast<size_t>(animation);
    take(pose, "seconds", session.pose.seconds, 0, kLongestTime);
  });
  within(document, "camera",
         [&](const json& camera) { session.camera = scene::cameraFromJson(camera, "camera"); });
  with(document, "effects", [&](const json& list) { session.effects = stateOf(list, "effects"); });
  with(document, "held", [&](const json& list) { session.held = stateOf(list, "held"); });
  within(document, "objects", [&](const json& objects) {
    for (const auto& [effect, list] : objects.items()) session.objects[effect] = list.dump();
  });
  within(document, "view", [&](const json& view) { takeView(view, session); });
  within(document, "truth", [&](const json& truth) { takeTruth(truth, session.comparing); });
  within(document, "sequence",
         [&](const json& sequence) { takeSequence(sequence, session.sequence); });
  take(document, "backend", session.backend);
  within(document, "panel", [&](const json& panel) { session.layout = layoutOf(panel); });
  return session;
}

}  // namespace

std::string sessionJson(const SavedSession& session, const fs::path& folder) {
  ordered_json document;
  document[kMark] = kVersion;
  document["scene"] = session.scene;
  if (scene::findBuiltIn(session.scene) == nullptr) {
    const fs::path beside = fs::path(session.scene).lexically_relative(folder);
    if (!beside.empty()) document["scene_beside"] = beside.string();
  }
  if (session.pose.animation) {
    document["pose"] = {{"animation", *session.pose.animation}, {"seconds", session.pose.seconds}};
  }
  if (session.camera) {
    document["camera"] = ordered_json::parse(scene::cameraJson(*session.camera));
  }
  document["effects"] = jsonOf(session.effects);
  if (session.held) document["held"] = jsonOf(*session.held);
  document["view"] = {{"surface", session.surface},
                      {"background", session.background},
                      {"left", session.left},
                      {"right", session.right},
                      {"split", session.split},
                      {"line", session.line},
                      {"inspecting", session.inspecting},
                      {"compare_by", kWays[static_cast<size_t>(session.splitting.way)]},
                      {"full_colour", session.splitting.full},
                      {"turn_seconds", session.splitting.turn},
                      {"right_backend", session.splitting.backend},
                      {"halves_while_moving", session.fineness.halves},
                      {"converges_at_rest", session.fineness.converges}};
  document["truth"] = {{"on", session.comparing.on},
                       {"output", session.comparing.output},
                       {"rays", session.comparing.rays}};
  if (session.comparing.radius) document["truth"]["radius"] = *session.comparing.radius;
  document["sequence"] = jsonOf(session.sequence);
  document["backend"] = session.backend;
  if (session.layout) {
    document["panel"] = {{"light", session.layout->light},
                         {"text_scale", session.layout->textScale},
                         {"panel_width", session.layout->panelWidth},
                         {"sections", session.layout->sections}};
  }
  // The lists are text already, and may be long: they are put in as they are.
  std::string text = document.dump(1, ' ', false, ordered_json::error_handler_t::replace);
  text.erase(text.rfind('\n'));
  text += ",\n \"objects\": {";
  bool first = true;
  for (const auto& [effect, list] : session.objects) {
    text += fmt::format("{}\n  {}: {}", first ? "" : ",", json(effect).dump(), list);
    first = false;
  }
  return text + "}\n}\n";
}

SavedSession parseSession(std::string_view text, const fs::path& folder) {
  try {
    return sessionOf(json::parse(text), folder);
  } catch (const Error& error) {
    throw Error(ErrorId::kSessionFile, "{}", error.detail());
  } catch (const json::exception& error) {
    throw Error(ErrorId::kSessionFile, "{}", oneLine(error.what()));
  }
}

SavedSession loadSession(const fs::path& file) {
  const std::string text = readRegularFile(file, ErrorId::kSessionFile, kLargestSession);
  try {
    return parseSession(text, file.parent_path());
  } catch (const Error& error) {
    throw Error(ErrorId::kSessionFile, "{}: {}", file.string(), error.detail());
  }
}

void saveSession(const SavedSession& session, const fs::path& file) {
  std::error_code failed;
  const fs::path whole = fs::absolute(file, failed).lexically_normal();
  if (!failed) fs::create_directories(whole.parent_path(), failed);  // on failure, writing throws
  writeFileAtomically(file.string(), sessionJson(session, whole.parent_path()));
}

bool isSessionFile(const fs::path& file) {
  if (!whyNotRegular(file).empty()) return false;
  std::ifstream stream(file, std::ios::binary);
  std::string head(64, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(stream.gcount()));
  const size_t at = head.find('"');
  return at != std::string::npos &&
         head.compare(at + 1, std::string_view(kMark).size(), kMark) == 0;
}

}  // namespace grisaille::app::viewer
