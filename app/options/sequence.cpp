// SPDX-License-Identifier: MIT
#include "app/options/sequence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <regex>

#include "core/base/error.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostDigits = 9;  // every number of 9 digits fits an int
constexpr size_t kLongestName = 4096;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// The frame number of `digits`; none if FileName::at() would not write these digits.
std::optional<int> frameIn(std::string_view digits, size_t width) {
  if (digits.size() < width || digits.size() > kMostDigits || digits.empty() ||
      !std::ranges::all_of(digits, isDigit)) {
    return std::nullopt;
  }
  if (digits.size() > width && digits[0] == '0' && digits.size() > 1) return std::nullopt;
  int number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

struct Fraction {
  double above = 0, below = 1;
  double value() const { return above / below; }
};

// A number of 0 or more; none for other texts.
std::optional<double> numberIn(std::string_view text) {
  double number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = failed == std::errc() && end == text.data() + text.size();
  return whole && number >= 0 && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

// "4", "0.25" or "1/24".
std::optional<Fraction> fractionIn(std::string_view text) {
  const size_t slash = text.find('/');
  const auto above = numberIn(text.substr(0, slash));
  const auto below = slash == std::string_view::npos ? 1 : numberIn(text.substr(slash + 1));
  if (!above || !below || *below == 0) return std::nullopt;
  return Fraction{*above, *below};
}

std::string shortened(const std::string& text) {
  return text.size() > 60 ? text.substr(0, 60) + "..." : text;
}

}  // namespace

FileName::FileName(const std::string& text) : text_(text), before_(text) {
  // std::regex uses stack space for every character.
  if (text.size() > kLongestName) {
    throw Error(ErrorId::kSequence, "'{}...' is longer than the longest path, {} bytes",
                text.substr(0, 40), kLongestName);
  }
  static const std::regex kNumber("##+|%(0([1-9]))?d");
  std::smatch match;
  if (!std::regex_search(text, match, kNumber)) return;
  before_ = match.prefix();
  after_ = match.suffix();
  width_ = match.str()[0] == '#' ? match.length() : match[2].matched ? std::stoul(match[2]) : 1;
  if (std::regex_search(after_, kNumber)) {
    throw Error(ErrorId::kSequence, "'{}' has more than one frame number", text);
  }
  if (after_.find('/') != std::string::npos) {
    throw Error(ErrorId::kSequence, "'{}' has a frame number in its folder, not in its file name",
                text);
  }
  if (width_ > kMostDigits) {
    throw Error(ErrorId::kSequence, "'{}' has frame numbers of more than {} digits", text,
                kMostDigits);
  }
}

std::string FileName::at(int number) const {
  if (!numbered()) return text_;
  return fmt::format("{}{:0{}}{}", before_, number, width_, after_);
}

std::string FileName::pattern() const {
  std::string text;
  const auto add = [&](const std::string& part) {
    for (const char c : part) text += c == '%' ? "%%" : std::string(1, c);
  };
  add(before_);
  if (numbered()) text += fmt::format("%0{}d", width_);
  add(after_);
  return text;
}

std::vector<int> FileName::numbers() const {
  const fs::path folder = fs::path(before_ + "x").parent_path();
  const std::string before = before_.substr(before_.rfind('/') + 1);
  std::vector<int> found;
  std::error_code failed;
  for (fs::directory_iterator file(folder.empty() ? "." : folder, failed);
       !failed && file != fs::directory_iterator(); file.increment(failed)) {
    const std::string name = file->path().filename();
    if (name.size() <= before.size() + after_.size() || !name.starts_with(before) ||
        !name.ends_with(after_)) {
      continue;
    }
    const auto number = frameIn(
        std::string_view(name).substr(before.size(), name.size() - before.size() - after_.size()),
        width_);
    if (number) found.push_back(*number);
  }
  if (found.empty()) throw Error(ErrorId::kSequence, "no file matches '{}'", text_);
  std::ranges::sort(found);
  return found;
}

std::vector<int> parseFrames(const std::string& text) {
  static const std::regex kRange("([0-9]{1,9})(-([0-9]{1,9})(x([0-9]{1,9}))?)?");
  std::smatch match;
  if (!std::regex_match(text, match, kRange)) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form FIRST-LAST or FIRST-LASTxSTEP", text);
  }
  const int first = std::stoi(match[1]);
  const int last = match[3].matched ? std::stoi(match[3]) : first;
  const int step = match[5].matched ? std::stoi(match[5]) : 1;
  constexpr int kMost = 1000000;
  if (last < first || step < 1 || (last - first) / step >= kMost) {
    throw Error(ErrorId::kUsage, "'{}' is not a range of 1 to {} frames", text, kMost);
  }
  std::vector<int> frames;
  for (int number = first; number <= last; number += step) frames.push_back(number);
  return frames;
}

std::vector<double> parseTimes(const std::string& text) {
  const size_t one = text.find(':'), two = text.find(':', one == std::string::npos ? one : one + 1);
  std::optional<Fraction> first, last, step;
  if (two != std::string::npos) {
    first = fractionIn(text.substr(0, one));
    last = fractionIn(text.substr(one + 1, two - one - 1));
    step = fractionIn(text.substr(two + 1));
  }
  if (!first || !last || !step) {
    throw Error(ErrorId::kUsage,
                "'{}' is not of the form FIRST:LAST:STEP, in seconds; a step may be a fraction, as "
                "in 0:4:1/24",
                shortened(text));
  }
  if (!(step->value() > 0 && last->value() >= first->value())) {
    throw Error(ErrorId::kUsage, "'{}' needs a step over 0, and a last time not before the first",
                shortened(text));
  }
  constexpr double kRounding = 1e-6;  // of a step
  constexpr double kMost = 100000;
  const double steps = std::floor((last->value() - first->value()) / step->value() + kRounding);
  if (!(steps < kMost)) {
    throw Error(ErrorId::kUsage, "'{}' has more than {} frames", shortened(text), kMost);
  }
  std::vector<double> times;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    const double time = first->value() + i * step->above / step->below;
    const bool ends = std::abs(time - last->value()) <= kRounding * step->value();
    times.push_back(ends ? last->value() : time);
  }
  return times;
}

}  // namespace grisaille::app
