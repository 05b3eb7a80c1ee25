// SPDX-License-Identifier: MIT
// The desktop portal's file dialog (org.freedesktop.portal.FileChooser), on a thread of its own.
//
// The D-Bus library is libsystemd's sd-bus, loaded when the dialog is asked for: nothing depends on
// it, and a system without it, without a session bus or without a portal uses the panel's dialog.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>

namespace grisaille::app::viewer {

// The path of a file: URI; none for any other.
std::optional<std::string> pathOfUri(const std::string& uri);

class Portal {
 public:
  struct Outcome {
    bool missing = false;  // there is no portal: show another dialog
    std::string path;      // "": the user has cancelled
  };

  Portal() = default;
  ~Portal();  // gives the dialog up
  Portal(const Portal&) = delete;
  Portal& operator=(const Portal&) = delete;

  // Shows the dialog. False if one is shown already.
  bool start();
  bool running() const { return result_.valid(); }
  // The outcome, once; none while the dialog is shown.
  std::optional<Outcome> take();

 private:
  std::shared_ptr<std::atomic<bool>> givenUp_ = std::make_shared<std::atomic<bool>>(false);
  std::future<Outcome> result_;
};

}  // namespace grisaille::app::viewer
