// SPDX-License-Identifier: MIT
#include "app/viewer/touchpad.h"

#include <X11/Xlib.h>
#include <X11/extensions/XI.h>
#include <X11/extensions/XInput.h>
#include <X11/extensions/XInput2.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <semaphore>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace grisaille::app::viewer {
namespace {

constexpr int kFingers = 2;  // pinches of more fingers belong to the desktop

// While it lives, errors of a connection do nothing, for example of a device that is gone already.
// Xlib's own handler would end the program. Main thread only.
class ErrorsIgnored {
 public:
  explicit ErrorsIgnored(Display* display) {
    of() = display;
    before() = XSetErrorHandler(
        [](Display* at, XErrorEvent* error) { return at == of() ? 0 : before()(at, error); });
  }
  ~ErrorsIgnored() {
    XSync(of(), False);
    XSetErrorHandler(before());
  }
  ErrorsIgnored(const ErrorsIgnored&) = delete;
  ErrorsIgnored& operator=(const ErrorsIgnored&) = delete;

 private:
  static Display*& of() {
    static Display* display = nullptr;
    return display;
  }
  static XErrorHandler& before() {
    static XErrorHandler handler = nullptr;
    return handler;
  }
};

// Calls `wake` when a connection has something to read, then waits for drained().
class Watch {
 public:
  Watch(int connection, std::function<void()> wake)
      : wake_(std::move(wake)), thread_([this, connection] { run(connection); }) {}
  ~Watch() {
    const uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = write(end_, &one, sizeof(one));
    drained_.release();
    thread_.join();
    close(end_);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void drained() {
    if (told_.exchange(false)) drained_.release();
  }

 private:
  void run(int connection) {
    pollfd ready[] = {{.fd = connection, .events = POLLIN, .revents = 0},
                      {.fd = end_, .events = POLLIN, .revents = 0}};
    while (true) {
      if (::poll(ready, std::size(ready), -1) < 0) continue;  // a signal
      if (ready[1].revents != 0) return;
      told_ = true;
      wake_();
      drained_.acquire();
    }
  }

  std::function<void()> wake_;
  int end_ = eventfd(0, EFD_CLOEXEC);
  std::atomic<bool> told_ = false;
  std::counting_semaphore<> drained_{0};
  std::thread thread_;
};

// A device with fingers on it.
struct Pad {
  int device = 0;
  struct Axis {
    int valuator = 0;
    ScrollAxis position;
  };
  std::array<std::optional<Axis>, 2> axes;  // horizontal, vertical
  PinchScale pinch;
};

class XTouchpad : public Touchpad {
 public:
  XTouchpad(Display* display, int opcode, Window window, std::function<void()> wake)
      : display_(display, XCloseDisplay), opcode_(opcode), window_(window) {
    findPads();
    watch_.emplace(ConnectionNumber(display), std::move(wake));
  }

  FingerMove poll(bool complete) override {
    FingerMove move;
    if (complete) XSync(display_.get(), False);
    bool found = false;
    while (XEventsQueued(display_.get(), QueuedAfterReading) > 0 || std::exchange(found, false)) {
      if (takeEvents(move)) {
        findPads();
        found = true;  // may have read further events
      }
    }
    watch_->drained();
    return move;
  }

 private:
  void findPads();
  std::optional<Pad> padOf(const XIDeviceInfo& device, bool isTouchpad) const;
  bool takeEvents(FingerMove& move);
  void scroll(Pad& pad, const XIDeviceEvent& event, FingerMove& move) const;
  static void pinch(Pad& pad, const XIGesturePinchEvent& event, FingerMove& move);
  Pad* padAt(int device) {
    const auto pad = std::ranges::find(pads_, device, &Pad::device);
    return pad == pads_.end() ? nullptr : &*pad;
  }

  std::unique_ptr<Display, int (*)(Display*)> display_;
  int opcode_;  // of XInput's events
  Window window_;
  std::vector<Pad> pads_;
  std::optional<Watch> watch_;
};

// The devices that the drivers libinput, synaptics and evdev call a touchpad.
std::vector<int> touchpadsOf(Display* display) {
  std::vector<int> touchpads;
  const Atom type = XInternAtom(display, XI_TOUCHPAD, True);
  int count = 0;
  XDeviceInfo* all = XListInputDevices(display, &count);
  for (const XDeviceInfo& device : std::span(all, static_cast<size_t>(all ? count : 0))) {
    if (type != None && device.type == type) touchpads.push_back(static_cast<int>(device.id));
  }
  if (all != nullptr) XFreeDeviceList(all);
  return touchpads;
}

// None if the device has neither two fingers' scroll nor pinches.
std::optional<Pad> XTouchpad::padOf(const XIDeviceInfo& device, bool isTouchpad) const {
  Pad pad{.device = device.deviceid, .axes = {}, .pinch = {}};
  bool useful = false;
  for (const XIAnyClassInfo* any :
       std::span(device.classes, static_cast<size_t>(device.num_classes))) {
    useful = useful || any->type == XIGestureClass;
    if (any->type != XIScrollClass || !isTouchpad) continue;
    const auto& scroll = *reinterpret_cast<const XIScrollClassInfo*>(any);
    if (scroll.increment == 0) continue;
    pad.axes[scroll.scroll_type == XIScrollTypeVertical ? 1 : 0] = {
        .valuator = scroll.number, .position = ScrollAxis(scroll.increment)};
    useful = true;
  }
  return useful ? std::optional(pad) : std::nullopt;
}

// Selects events of the devices themselves: the server does not send events of the master pointer
// to GLFW if another client selects them by XInput 2. Entering is told to both.
void XTouchpad::findPads() {
  const ErrorsIgnored guard(display_.get());
  const auto select = [&](int device, std::initializer_list<int> events) {
    std::array<unsigned char, XIMaskLen(XI_LASTEVENT)> bits{};
    // As XISetMask, whose conversions warn.
    for (const int event : events) {
      auto& byte = bits[static_cast<size_t>(event >> 3)];
      byte = static_cast<unsigned char>(byte | 1 << (event & 7));
    }
    XIEventMask mask{
        .deviceid = device, .mask_len = static_cast<int>(bits.size()), .mask = bits.data()};
    XISelectEvents(display_.get(), window_, &mask, 1);
  };
  select(XIAllDevices, {XI_HierarchyChanged});
  select(XIAllMasterDevices, {XI_Enter});
  pads_.clear();
  const std::vector<int> touchpads = touchpadsOf(display_.get());
  int count = 0;
  XIDeviceInfo* all = XIQueryDevice(display_.get(), XIAllDevices, &count);
  for (const XIDeviceInfo& device : std::span(all, static_cast<size_t>(all ? count : 0))) {
    if (device.use != XISlavePointer) continue;
    const auto pad = padOf(device, std::ranges::count(touchpads, device.deviceid) > 0);
    if (!pad) continue;
    pads_.push_back(*pad);
    select(device.deviceid,
           {XI_Motion, XI_GesturePinchBegin, XI_GesturePinchUpdate, XI_GesturePinchEnd});
  }
  if (all != nullptr) XIFreeDeviceInfo(all);
}

void XTouchpad::scroll(Pad& pad, const XIDeviceEvent& event, FingerMove& move) const {
  const XIValuatorState& state = event.valuators;
  const double* value = state.values;  // of the valuators in the mask alone
  for (int valuator = 0; valuator < 8 * state.mask_len; ++valuator) {
    if (!XIMaskIsSet(state.mask, valuator)) continue;
    for (int side = 0; side < 2; ++side) {
      auto& axis = pad.axes[static_cast<size_t>(side)];
      if (!axis || axis->valuator != valuator) continue;
      move.scrolled = true;
      move.notches[side] += axis->position.moveTo(*value);
    }
    ++value;
  }
}

void XTouchpad::pinch(Pad& pad, const XIGesturePinchEvent& event, FingerMove& move) {
  if (event.detail != kFingers) return;
  if (event.evtype == XI_GesturePinchBegin) pad.pinch.begin();
  if (event.evtype == XI_GesturePinchUpdate) move.scale *= pad.pinch.moveTo(event.scale);
}

// Takes the events that are there. True if devices came or went.
bool XTouchpad::takeEvents(FingerMove& move) {
  bool changed = false;
  while (XEventsQueued(display_.get(), QueuedAlready) > 0) {
    XEvent event;
    XNextEvent(display_.get(), &event);
    XGenericEventCookie& cookie = event.xcookie;
    if (cookie.type != GenericEvent || cookie.extension != opcode_) continue;
    if (!XGetEventData(display_.get(), &cookie)) continue;
    if (cookie.evtype == XI_HierarchyChanged) changed = true;
    if (cookie.evtype == XI_Enter) {
      for (Pad& pad : pads_) {
        for (auto& axis : pad.axes) {
          if (axis) axis->position.forget();
        }
      }
    }
    if (cookie.evtype == XI_Motion) {
      const auto& motion = *static_cast<const XIDeviceEvent*>(cookie.data);
      if (Pad* pad = padAt(motion.deviceid)) scroll(*pad, motion, move);
    }
    if (cookie.evtype == XI_GesturePinchBegin || cookie.evtype == XI_GesturePinchUpdate) {
      const auto& gesture = *static_cast<const XIGesturePinchEvent*>(cookie.data);
      if (Pad* pad = padAt(gesture.deviceid)) pinch(*pad, gesture, move);
    }
    XFreeEventData(display_.get(), &cookie);
  }
  return changed;
}

}  // namespace

std::unique_ptr<Touchpad> Touchpad::of(unsigned long window, std::function<void()> wake) {
  if (window == 0) return nullptr;
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return nullptr;
  int opcode = 0, event = 0, error = 0, major = 2, minor = 4;
  if (XQueryExtension(display, "XInputExtension", &opcode, &event, &error) == 0 ||
      XIQueryVersion(display, &major, &minor) != Success ||
      std::pair(major, minor) < std::pair(2, 4)) {
    XCloseDisplay(display);
    return nullptr;
  }
  return std::make_unique<XTouchpad>(display, opcode, window, std::move(wake));
}

}  // namespace grisaille::app::viewer
