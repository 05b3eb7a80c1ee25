// SPDX-License-Identifier: MIT
// Plugins of a build folder follow their sources: a change of a file starts the build of the plugin
// beside the window. What a build folder says of a plugin is in NAME.build.json beside
// NAME.so (cmake/GrisailleEffect.cmake writes it); a plugin without that file is left alone.
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
    std::string message;  // the compiler's words; "" where it is good
  };

  Rebuild() = default;
  ~Rebuild();  // waits for a build that runs

  // Watches the sources of these plugins and of no others.
  void watch(const effect::Registry& registry);

  // Looks at the files and starts a build where one has changed since the last look.
  void look();

  // The target that is being built; "": none.
  const std::string& building() const { return building_; }

  // Of a build that has ended since the last call.
  std::optional<Outcome> take();

 private:
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  struct Plugin {
    std::string folder, target;                  // of the build
    std::vector<std::filesystem::path> watched;  // files, and folders whose files count
    Times times;
  };
  static std::optional<Plugin> read(const std::filesystem::path& description);
  static Times timesOf(const Plugin& plugin);

  std::vector<Plugin> plugins_;
  std::string building_;
  std::unique_ptr<Child> build_;
};

}  // namespace grisaille::app::viewer
