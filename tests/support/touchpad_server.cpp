// SPDX-License-Identifier: MIT
#include "tests/support/touchpad_server.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <xorg/xf86-input-inputtest-protocol.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kIncrement = 120;                   // of the driver's scroll axes, per notch
constexpr int kHorizontal = 2, kVertical = 3;        // numbers of these axes
constexpr int kBegin = 27, kUpdate = 28, kEnd = 29;  // XI_GesturePinchBegin and the next ones

// The touchpad's type at the driver is PointerGesture; its socket lies in `folder`.
std::vector<std::string> command(const fs::path& folder, uint32_t side) {
  const std::string pixels = std::to_string(side);
  // No mode of a monitor fits; the dummy driver takes any.
  const std::string line = pixels + " " + std::to_string(side + 16) + " " +
                           std::to_string(side + 32) + " " + std::to_string(side + 64);
  const auto device = [&](const std::string& name, const std::string& type) {
    return "Section \"InputDevice\"\n Identifier \"" + name +
           "\"\n Driver \"inputtest\"\n Option \"DeviceType\" \"" + type +
           "\"\n Option \"SocketPath\" \"" + (folder / name).string() + "\"\nEndSection\n";
  };
  std::ofstream(folder / "xorg.conf")
      << "Section \"ServerFlags\"\n Option \"AutoAddDevices\" \"false\"\n"
         " Option \"AutoAddGPU\" \"false\"\nEndSection\n"
         "Section \"Device\"\n Identifier \"card\"\n Driver \"dummy\"\n VideoRam "
         "65536\nEndSection\n"
         "Section \"Monitor\"\n Identifier \"monitor\"\n HorizSync 1-1000\n VertRefresh 1-1000\n"
         " Modeline \"square\" 60 "
      << line << " " << line
      << "\nEndSection\n"
         "Section \"Screen\"\n Identifier \"screen\"\n Device \"card\"\n Monitor \"monitor\"\n"
         " DefaultDepth 24\n SubSection \"Display\"\n  Depth 24\n  Modes \"square\"\n  Virtual "
      << pixels << " " << pixels << "\n EndSubSection\nEndSection\n"
      << device("touchpad", "PointerGesture") << device("keyboard", "Keyboard")
      << "Section \"ServerLayout\"\n Identifier \"layout\"\n Screen \"screen\"\n"
         " InputDevice \"touchpad\" \"CorePointer\"\n InputDevice \"keyboard\" \"CoreKeyboard\"\n"
         "EndSection\n";
  // Another seat than the first has no console, which Xorg would take over.
  return {"sh",
          "-c",
          "exec Xorg \"$@\" >'" + (folder / "messages").string() + "' 2>&1",
          "Xorg",
          "-config",
          folder / "xorg.conf",
          "-logfile",
          folder / "log",
          "-seat",
          "grisaille",
          "-noreset",
          "-nolisten",
          "tcp"};
}

void check(bool good, const std::string& what) {
  if (!good) throw std::runtime_error("touchpad: " + what + ": " + std::strerror(errno));
}

}  // namespace

std::string TouchpadServer::obstacle() {
  if (geteuid() != 0) return "Xorg takes the test's configuration from root alone";
  for (const char* file : {"/usr/bin/Xorg", "/usr/lib/xorg/modules/input/inputtest_drv.so",
                           "/usr/lib/xorg/modules/drivers/dummy_drv.so"}) {
    if (!fs::exists(file)) {
      return std::string(file) +
             " is missing: install xserver-xorg-core and xserver-xorg-video-dummy";
    }
  }
  return "";
}

TouchpadServer::TouchpadServer(uint32_t side) : display_(command(folder_.path(), side)) {
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = folder_ / "touchpad";
  check(path.size() < sizeof(address.sun_path), "the path is too long");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  check(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0, path);
  xf86ITEventClientVersion version{};
  version.major = XF86IT_PROTOCOL_VERSION_MAJOR;
  version.minor = 0;
  send(version, XF86IT_EVENT_CLIENT_VERSION);
  xf86ITResponseServerVersion answer{};
  check(recv(socket_, &answer, sizeof(answer), MSG_WAITALL) == sizeof(answer), "no version");
}

TouchpadServer::~TouchpadServer() {
  close(socket_);
}

template <typename Event>
void TouchpadServer::send(Event event, int type) const {
  event.header.length = sizeof(event);
  event.header.type = static_cast<xf86ITEventType>(type);
  check(::send(socket_, &event, sizeof(event), MSG_NOSIGNAL) == sizeof(event), "cannot send");
}

// The driver never answers if no event came before.
void TouchpadServer::wait() const {
  send(xf86ITEventWaitForSync{}, XF86IT_EVENT_WAIT_FOR_SYNC);
  xf86ITResponseSyncFinished answer{};
  check(recv(socket_, &answer, sizeof(answer), MSG_WAITALL) == sizeof(answer), "no answer");
}

void TouchpadServer::scroll(double right, double down, int steps) {
  xf86ITEventMotion motion{};
  motion.valuators.mask[0] = 1 << kHorizontal | 1 << kVertical;
  motion.valuators.valuators[kHorizontal] = right * kIncrement / steps;
  motion.valuators.valuators[kVertical] = down * kIncrement / steps;
  for (int i = 0; i < steps; ++i) {
    send(motion, XF86IT_EVENT_MOTION);
    wait();
  }
}

void TouchpadServer::pinch(double scale, int steps, int fingers) {
  xf86ITEventGesturePinch pinch{};
  pinch.num_touches = static_cast<uint16_t>(fingers);
  pinch.scale = 1;
  const auto tell = [&](int type) {
    pinch.gesture_type = static_cast<uint16_t>(type);
    send(pinch, XF86IT_EVENT_GESTURE_PINCH);
    wait();
  };
  tell(kBegin);
  for (int i = 1; i <= steps; ++i) {
    pinch.scale = std::pow(scale, static_cast<double>(i) / steps);
    tell(kUpdate);
  }
  tell(kEnd);
}

}  // namespace grisaille::tests
