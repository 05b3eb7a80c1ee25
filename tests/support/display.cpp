// SPDX-License-Identifier: MIT
#include "tests/support/display.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xcb/xcb.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

namespace grisaille::tests {
namespace {

template <typename Reply>
std::unique_ptr<Reply, void (*)(void*)> owned(Reply* reply) {
  if (reply == nullptr) throw std::runtime_error("the X server refused a request");
  return {reply, std::free};
}

xcb_screen_t* screenOf(xcb_connection_t* connection) {
  return xcb_setup_roots_iterator(xcb_get_setup(connection)).data;
}

xcb_atom_t atom(xcb_connection_t* connection, const char* name) {
  const auto cookie =
      xcb_intern_atom(connection, 0, static_cast<uint16_t>(std::strlen(name)), name);
  return owned(xcb_intern_atom_reply(connection, cookie, nullptr))->atom;
}

}  // namespace

Display::Display(uint32_t width, uint32_t height)
    : Display(std::vector<std::string>{"Xvfb", "-screen", "0",
                                       std::to_string(width) + "x" + std::to_string(height) + "x24",
                                       "-nolisten", "tcp", "-noreset"}) {}

Display::Display(std::vector<std::string> command) {
  const char* before = std::getenv("DISPLAY");
  before_ = before != nullptr ? before : "";
  start(std::move(command));
  try {
    connect();
  } catch (...) {
    stop();
    throw;
  }
  setenv("DISPLAY", name_.c_str(), 1);
}

Display::~Display() {
  if (before_.empty()) {
    unsetenv("DISPLAY");
  } else {
    setenv("DISPLAY", before_.c_str(), 1);
  }
  xcb_disconnect(connection_);
  stop();
}

// The server writes its display number to a pipe as soon as it accepts connections.
void Display::start(std::vector<std::string> command) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot create a pipe");
  command.insert(command.end(), {"-displayfd", std::to_string(ends[1])});
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t parent = getpid();
  server_ = fork();
  if (server_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // ends the server even if a signal kills the test
    if (getppid() != parent) _exit(127);
    close(ends[0]);
    execvp(words[0], words.data());
    _exit(127);
  }
  close(ends[1]);
  std::string number;
  char read1 = 0;
  while (server_ > 0 && read(ends[0], &read1, 1) == 1 && read1 != '\n') number += read1;
  close(ends[0]);
  name_ = ":" + number;
  if (!number.empty()) return;
  stop();
  std::string line;
  for (const std::string& word : command) line += " " + word;
  throw std::runtime_error("no X server starts; is its package installed?" + line);
}

void Display::connect() {
  connection_ = xcb_connect(name_.c_str(), nullptr);
  if (xcb_connection_has_error(connection_) == 0) return;
  xcb_disconnect(connection_);
  throw std::runtime_error("the X server accepts no connection at " + name_);
}

void Display::stop() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
  server_ = 0;
}

std::vector<uint32_t> Display::pixels(uint32_t x, uint32_t y, uint32_t width,
                                      uint32_t height) const {
  const auto cookie = xcb_get_image(
      connection_, XCB_IMAGE_FORMAT_Z_PIXMAP, screenOf(connection_)->root, static_cast<int16_t>(x),
      static_cast<int16_t>(y), static_cast<uint16_t>(width), static_cast<uint16_t>(height), ~0u);
  const auto image = owned(xcb_get_image_reply(connection_, cookie, nullptr));
  std::vector<uint32_t> pixels(size_t{width} * height);
  const auto bytes = static_cast<size_t>(xcb_get_image_data_length(image.get()));
  if (bytes != pixels.size() * sizeof(uint32_t)) {
    throw std::runtime_error("the X server's pixels do not have 32 bits");
  }
  std::memcpy(pixels.data(), xcb_get_image_data(image.get()), bytes);
  for (uint32_t& pixel : pixels) pixel &= 0xffffff;
  return pixels;
}

void Display::setScale(double scale) const {
  const std::string text = "Xft.dpi:\t" + std::to_string(std::lround(96 * scale)) + "\n";
  xcb_change_property(connection_, XCB_PROP_MODE_REPLACE, screenOf(connection_)->root,
                      XCB_ATOM_RESOURCE_MANAGER, XCB_ATOM_STRING, 8,
                      static_cast<uint32_t>(text.size()), text.c_str());
  owned(xcb_get_input_focus_reply(connection_, xcb_get_input_focus(connection_), nullptr));  // sync
}

void Display::markIconified(bool iconified) const {
  const xcb_atom_t state = atom(connection_, "WM_STATE");
  const uint32_t value[] = {iconified ? 3u : 1u, XCB_NONE};  // IconicState, NormalState; no icon
  const auto tree = owned(xcb_query_tree_reply(
      connection_, xcb_query_tree(connection_, screenOf(connection_)->root), nullptr));
  const xcb_window_t* windows = xcb_query_tree_children(tree.get());
  for (int i = 0; i < xcb_query_tree_children_length(tree.get()); ++i) {
    xcb_change_property(connection_, XCB_PROP_MODE_REPLACE, windows[i], state, state, 32, 2, value);
  }
  owned(xcb_get_input_focus_reply(connection_, xcb_get_input_focus(connection_), nullptr));  // sync
}

}  // namespace grisaille::tests
