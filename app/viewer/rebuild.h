// SPDX-License-Identifier: MIT
// Rebuilds the plugins of a build folder when their sources change. The build runs as a child
// process. NAME.build.json beside NAME.so describes the build of a plugin
// (cmake/GrisailleEffect.cmake writes it); plugins without this file are never rebuilt.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/process/child.h"
#include "core/effect/registry.h"

namespace grisaille::app::viewer {

class Rebuild {
 public:
  struct Outcome {
    bool good = false;
    std::string message;  // the compiler's output, shortened; "" if `good`
  };

  Rebuild() = default;
  ~Rebuild();  // waits for a running build

  // Watches the sources of these plugins, refused ones included, and of no others.
  void watch(const effect::Registry& registry);

  // Starts a build if a watched file has changed since the last call. One build at a time.
  void look();

  // The build target in progress; "": none.
  const std::string& building() const { return building_; }

  // The outcome of a build that has ended since the last call; else none.
  std::optional<Outcome> take();

 private:
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  struct Plugin {
    std::string folder, target;                  // build folder and build target
    std::vector<std::filesystem::path> watched;  // files, and folders with all their files
    Times times;
  };
  static std::optional<Plugin> read(const std::filesystem::path& description);
  static Times timesOf(const Plugin& plugin);

  std::vector<Plugin> plugins_;
  std::string building_;
  std::unique_ptr<Child> build_;
};

}  // namespace grisaille::app::viewer
