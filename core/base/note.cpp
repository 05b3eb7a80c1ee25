// SPDX-License-Identifier: MIT
#include "core/base/note.h"

#include <mutex>
#include <set>

#include "core/base/error.h"

namespace grisaille {
namespace {

struct Notes {
  std::mutex mutex;
  std::set<std::string, std::less<>> seen;
  std::function<void(const std::string&)> listener;
};

Notes& notes() {
  static Notes all;
  return all;
}

}  // namespace

void note(std::string_view line) {
  Notes& all = notes();
  const std::lock_guard lock(all.mutex);
  if (all.listener && all.seen.emplace(line).second) all.listener(oneLine(line));
}

void setNoteListener(std::function<void(const std::string&)> listener) {
  Notes& all = notes();
  const std::lock_guard lock(all.mutex);
  all.listener = std::move(listener);
  all.seen.clear();
}

}  // namespace grisaille
