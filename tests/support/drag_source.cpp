// SPDX-License-Identifier: MIT
#include "tests/support/drag_source.h"

#include <poll.h>
#include <xcb/xcb.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace grisaille::tests {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kVersion = 5;
constexpr std::chrono::seconds kPatience(20);

template <typename Reply>
std::unique_ptr<Reply, void (*)(void*)> replyOf(Reply* reply) {
  if (reply == nullptr) throw std::runtime_error("the X server refused a request");
  return {reply, std::free};
}

// One drag, from its own window.
class Drag {
 public:
  Drag() : connection_(xcb_connect(nullptr, nullptr), xcb_disconnect) {
    if (xcb_connection_has_error(connection_.get()) != 0) {
      throw std::runtime_error("no X server");
    }
    const xcb_screen_t* screen = xcb_setup_roots_iterator(xcb_get_setup(x())).data;
    root_ = screen->root;
    window_ = xcb_generate_id(x());
    xcb_create_window(x(), XCB_COPY_FROM_PARENT, window_, root_, 0, 0, 1, 1, 0,
                      XCB_WINDOW_CLASS_INPUT_OUTPUT, screen->root_visual, 0, nullptr);
    xcb_set_selection_owner(x(), window_, atom("XdndSelection"), XCB_CURRENT_TIME);
    target_ = findTarget();
  }

  void drop(const std::string& list, int left, int top) {
    const xcb_atom_t uris = atom("text/uri-list");
    send("XdndEnter", kVersion << 24, uris, 0, 0);
    const uint32_t place = static_cast<uint32_t>(left) << 16 | static_cast<uint32_t>(top);
    send("XdndPosition", 0, place, XCB_CURRENT_TIME, atom("XdndActionCopy"));
    const auto status = until("XdndStatus", list);
    if ((status.data.data32[1] & 1u) == 0) throw std::runtime_error("the window takes no file");
    send("XdndDrop", 0, XCB_CURRENT_TIME, 0, 0);
    const auto finished = until("XdndFinished", list);
    // Bit 0 by the protocol; GLFW tells the number of bytes instead.
    if (finished.data.data32[1] == 0) throw std::runtime_error("the drop was not taken");
  }

 private:
  xcb_connection_t* x() const { return connection_.get(); }

  xcb_atom_t atom(const std::string& name) const {
    const auto cookie = xcb_intern_atom(x(), 0, static_cast<uint16_t>(name.size()), name.c_str());
    return replyOf(xcb_intern_atom_reply(x(), cookie, nullptr))->atom;
  }

  // The window that says it takes drops.
  xcb_window_t findTarget() const {
    const auto tree = replyOf(xcb_query_tree_reply(x(), xcb_query_tree(x(), root_), nullptr));
    const xcb_window_t* windows = xcb_query_tree_children(tree.get());
    const xcb_atom_t aware = atom("XdndAware");
    for (int i = 0; i < xcb_query_tree_children_length(tree.get()); ++i) {
      const auto cookie = xcb_get_property(x(), 0, windows[i], aware, XCB_ATOM_ATOM, 0, 1);
      const auto property = replyOf(xcb_get_property_reply(x(), cookie, nullptr));
      if (property->type != XCB_NONE) return windows[i];
    }
    throw std::runtime_error("no window takes drops");
  }

  void send(const char* type, uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
    xcb_client_message_event_t event{};
    event.response_type = XCB_CLIENT_MESSAGE;
    event.format = 32;
    event.window = target_;
    event.type = atom(type);
    const uint32_t words[] = {window_, a, b, c, d};
    std::memcpy(event.data.data32, words, sizeof(words));
    xcb_send_event(x(), 0, target_, XCB_EVENT_MASK_NO_EVENT, reinterpret_cast<const char*>(&event));
    xcb_flush(x());
  }

  // Gives the target the list when it asks for it, until a message of this type arrives.
  xcb_client_message_event_t until(const char* type, const std::string& list) const {
    const xcb_atom_t wanted = atom(type);
    for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
      pollfd ready = {.fd = xcb_get_file_descriptor(x()), .events = POLLIN, .revents = 0};
      const std::unique_ptr<xcb_generic_event_t, void (*)(void*)> event(xcb_poll_for_event(x()),
                                                                        std::free);
      if (!event) {
        poll(&ready, 1, 20);
        continue;
      }
      const int kind = event->response_type & 0x7f;
      if (kind == XCB_SELECTION_REQUEST) {
        answer(*reinterpret_cast<const xcb_selection_request_event_t*>(event.get()), list);
      } else if (kind == XCB_CLIENT_MESSAGE) {
        const auto& message = *reinterpret_cast<const xcb_client_message_event_t*>(event.get());
        if (message.type == wanted) return message;
      }
    }
    throw std::runtime_error(std::string("no ") + type);
  }

  void answer(const xcb_selection_request_event_t& request, const std::string& list) const {
    xcb_change_property(x(), XCB_PROP_MODE_REPLACE, request.requestor, request.property,
                        request.target, 8, static_cast<uint32_t>(list.size()), list.data());
    xcb_selection_notify_event_t notify{};
    notify.response_type = XCB_SELECTION_NOTIFY;
    notify.time = request.time;
    notify.requestor = request.requestor;
    notify.selection = request.selection;
    notify.target = request.target;
    notify.property = request.property;
    xcb_send_event(x(), 0, request.requestor, XCB_EVENT_MASK_NO_EVENT,
                   reinterpret_cast<const char*>(&notify));
    xcb_flush(x());
  }

  std::unique_ptr<xcb_connection_t, void (*)(xcb_connection_t*)> connection_;
  xcb_window_t root_ = 0, window_ = 0, target_ = 0;
};

}  // namespace

void dropUris(const std::vector<std::string>& uris, int x, int y) {
  std::string list;
  for (const std::string& uri : uris) list += uri + "\r\n";
  Drag().drop(list, x, y);
}

}  // namespace grisaille::tests
