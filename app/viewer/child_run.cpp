// SPDX-License-Identifier: MIT
#include "app/viewer/child_run.h"

#include <nlohmann/json.hpp>

namespace grisaille::app::viewer {
using nlohmann::json;
namespace {

// The last complete line that is a JSON object; "": none.
std::string lastObject(const std::string& written) {
  size_t end = written.rfind('\n');
  while (end != std::string::npos && end > 0) {
    const size_t before = written.rfind('\n', end - 1);
    const size_t from = before == std::string::npos ? 0 : before + 1;
    std::string line = written.substr(from, end - from);
    if (json::parse(line, nullptr, false).is_object()) return line;
    end = before;
  }
  return "";
}

// The last line that is not empty.
std::string lastLine(const std::string& written) {
  const size_t end = written.find_last_not_of("\r\n");
  if (end == std::string::npos) return "";
  const size_t before = written.find_last_of("\r\n", end);
  const size_t from = before == std::string::npos ? 0 : before + 1;
  return written.substr(from, end + 1 - from);
}

}  // namespace

void ChildRun::start(const std::vector<std::string>& arguments) {
  if (child_) return;
  std::vector<std::string> words = program_;
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.emplace_back("--json");
  cancelled_ = false;
  child_ = std::make_unique<Child>(std::move(words));
}

ChildRun::State ChildRun::state() const {
  if (!child_) return {};
  if (cancelled_) return {0, "", "cancelling"};
  const std::string last = lastObject(child_->out());
  if (last.empty()) return {0, "", "starting"};
  const json told = json::parse(last);
  return {told.value("share", 0.0), told.value("progress", ""), told.value("text", "")};
}

void ChildRun::cancel() {
  if (!child_) return;
  cancelled_ = true;
  child_->end();
}

std::optional<ChildRun::Ended> ChildRun::take() {
  if (!child_ || child_->running()) return std::nullopt;
  Ended ended{.failure = "", .last = lastObject(child_->out())};
  if (cancelled_) {
    ended.failure = "cancelled";
  } else if (child_->status() != 0) {
    const std::string told = lastLine(child_->err());
    const bool killed = child_->status() < 0;
    ended.failure = !told.empty() ? told
                    : killed      ? "a signal ended it"
                                  : "it failed without a message";
  }
  child_.reset();
  return ended;
}

}  // namespace grisaille::app::viewer
