// SPDX-License-Identifier: MIT
// Read event by event, so that a million shots take no more memory than themselves and every value
// has its line.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <istream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <span>
#include <string>

#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/shots/formats.h"
#include "core/shots/shot.h"

namespace grisaille::shots {
namespace {

using nlohmann::json;

constexpr double kJsonVersion = 1;
constexpr size_t kChunk = size_t{1} << 16;

struct Place {
  uint64_t line = 1;
  uint64_t column = 0;
};

// The characters of a stream, and the place of the last one that was taken.
class CountedChars {
 public:
  explicit CountedChars(std::istream& in) : in_(in) {}

  bool ended() {
    if (at_ == filled_) fill();
    return at_ == filled_;
  }
  char current() const { return chunk_[at_]; }
  void next() { ++at_; }

  Place place() {
    if (at_ == 0) return {};
    countLines(at_ - 1);  // a line break belongs to the line that it ends
    return {line_, chunkStart_ + at_ - lineStart_};
  }

 private:
  void fill() {
    // The chunk's last character is kept for place().
    const size_t kept = filled_ > 0 ? 1 : 0;
    if (kept) {
      countLines(filled_ - 1);
      chunk_[0] = chunk_[filled_ - 1];
      chunkStart_ += filled_ - 1;
    }
    counted_ = 0;
    in_.read(chunk_.data() + kept, static_cast<std::streamsize>(kChunk - kept));
    if (in_.bad()) throw Error(ErrorId::kShotFileUnreadable, "{}: cannot be read from here", line_);
    at_ = kept;
    filled_ = kept + static_cast<size_t>(in_.gcount());
  }

  // Counts the line breaks of the chunk before `end`.
  void countLines(size_t end) {
    while (counted_ < end) {
      const void* found = std::memchr(chunk_.data() + counted_, '\n', end - counted_);
      if (!found) break;
      counted_ = static_cast<size_t>(static_cast<const char*>(found) - chunk_.data()) + 1;
      lineStart_ = chunkStart_ + counted_;
      ++line_;
    }
    counted_ = std::max(counted_, end);
  }

  std::istream& in_;
  std::array<char, kChunk> chunk_;
  uint64_t chunkStart_ = 0;  // characters before the chunk
  size_t at_ = 0;
  size_t filled_ = 0;
  size_t counted_ = 0;
  uint64_t line_ = 1;
  uint64_t lineStart_ = 0;  // characters before the line
};

// What nlohmann's parser takes its input from; the one without characters is the end.
struct CharIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  CountedChars* chars = nullptr;

  char operator*() const { return chars->current(); }
  CharIterator& operator++() {
    chars->next();
    return *this;
  }
  bool operator!=(const CharIterator& end) const { return chars != end.chars && !chars->ended(); }
};

constexpr std::array<std::string_view, 2> kFileMembers = {"version", "shots"};
constexpr std::array<std::string_view, 4> kShotMembers = {"origin", "direction", "color", "range"};
constexpr size_t kVersionMember = 0;
constexpr size_t kRangeMember = 3;

class Handler : public nlohmann::json_sax<json> {
 public:
  explicit Handler(CountedChars& chars) : chars_(chars) {}

  std::vector<grisaille_shot> take() { return std::move(shots_); }

  bool null() override { unexpected("null"); }
  bool boolean(bool) override { unexpected("true or false"); }
  bool string(string_t&) override { unexpected("a string"); }
  bool binary(binary_t&) override { unexpected("bytes"); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }

  bool start_object(size_t) override {
    if (inside_ == Inside::kNothing) {
      inside_ = Inside::kFile;
    } else if (inside_ == Inside::kShots) {
      inside_ = Inside::kShot;
      shotMembers_ = {};
      values_ = {};
      shotPlace_ = chars_.place();
    } else {
      unexpected("an object");
    }
    member_.reset();
    return true;
  }

  bool end_object() override {
    member_.reset();
    if (inside_ == Inside::kShot) {
      endShot();
      inside_ = Inside::kShots;
    } else {
      requireMembers(chars_.place(), kFileMembers, fileMembers_);
    }
    return true;
  }

  bool start_array(size_t) override {
    if (inside_ == Inside::kFile && *member_ != kVersionMember) {
      inside_ = Inside::kShots;
    } else if (inside_ == Inside::kShot && *member_ != kRangeMember) {
      inside_ = Inside::kVector;
      index_ = 0;
    } else {
      unexpected("an array");
    }
    return true;
  }

  bool end_array() override {
    if (inside_ == Inside::kVector) {
      inside_ = Inside::kShot;
      if (index_ != 3) {
        refuse(chars_.place(), fmt::format("{} holds {} numbers, not three", subject(), index_));
      }
    } else {
      inside_ = Inside::kFile;
    }
    return true;
  }

  bool key(string_t& name) override {
    return inside_ == Inside::kShot ? setMember(kShotMembers, shotMembers_, name)
                                    : setMember(kFileMembers, fileMembers_, name);
  }

  bool parse_error(size_t, const std::string&, const json::exception& error) override {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ...": the
    // place is ours to tell.
    std::string_view why = error.what();
    why.remove_prefix(std::min(why.size(), why.find("] ") + 2));
    if (why.starts_with("parse error at")) why.remove_prefix(why.find(": ") + 2);
    const std::string where = subject();
    refuse(chars_.place(), where.empty() ? std::string(why) : fmt::format("in {}: {}", where, why));
  }

 private:
  enum class Inside : uint8_t { kNothing, kFile, kShots, kShot, kVector };

  template <size_t count>
  bool setMember(const std::array<std::string_view, count>& members,
                 std::array<bool, count>& present, const std::string& name) {
    member_.reset();
    for (size_t i = 0; i < count; ++i) {
      if (members[i] == name) member_ = i;
    }
    if (!member_) {
      const std::vector<std::string> candidates(members.begin(), members.end());
      const std::string near = nearest(name, candidates);
      refuse(chars_.place(), fmt::format("{} has no member \"{}\"{}{}", owner(), name,
                                         near.empty() ? "" : ", nearest is ", near));
    }
    if (present[*member_]) {
      refuse(chars_.place(), fmt::format("{} has two members \"{}\"", owner(), name));
    }
    present[*member_] = true;
    return true;
  }

  bool number(double value) {
    if (inside_ == Inside::kVector) {
      std::array<double, 3>* const vectors[] = {&values_.origin, &values_.direction,
                                                &values_.color};
      if (index_ < 3) (*vectors[*member_])[index_] = value;
      ++index_;
    } else if (inside_ == Inside::kShot && *member_ == kRangeMember) {
      values_.range = value;
    } else if (inside_ == Inside::kFile && *member_ == kVersionMember) {
      if (value != kJsonVersion) {
        throw Error(ErrorId::kShotFileVersion, "{}:{}: version {}, and only {} can be read",
                    chars_.place().line, chars_.place().column, value, kJsonVersion);
      }
    } else {
      unexpected("a number");
    }
    return true;
  }

  void endShot() {
    requireMembers(shotPlace_, kShotMembers, std::span(shotMembers_).first<kRangeMember>());
    try {
      shots_.push_back(makeShot(values_));
    } catch (const Error& error) {
      refuse(shotPlace_, fmt::format("{}.{}", subject(), error.detail()));
    }
  }

  // `present`: of the first members, whether each was there. All must be.
  void requireMembers(Place place, std::span<const std::string_view> members,
                      std::span<const bool> present) const {
    for (size_t i = 0; i < present.size(); ++i) {
      if (present[i]) continue;
      refuse(place, fmt::format("{} has no \"{}\"", owner(), members[i]));
    }
  }

  // Whose members are being read.
  std::string owner() const {
    return inside_ == Inside::kShot ? fmt::format("shots[{}]", shots_.size()) : "the file";
  }

  // "shots[17].origin[1]"; "" outside of every member.
  std::string subject() const {
    if (inside_ == Inside::kNothing) return "";
    if (inside_ == Inside::kFile) return member_ ? std::string(kFileMembers[*member_]) : "";
    std::string text = fmt::format("shots[{}]", shots_.size());
    if (inside_ == Inside::kShots || !member_) return text;
    text += fmt::format(".{}", kShotMembers[*member_]);
    if (inside_ == Inside::kVector) text += fmt::format("[{}]", index_);
    return text;
  }

  [[noreturn]] void unexpected(std::string_view what) {
    std::string_view wanted;
    switch (inside_) {
      case Inside::kNothing:
      case Inside::kShots:
        wanted = "an object";
        break;
      case Inside::kFile:
        wanted = *member_ == kVersionMember ? "a number" : "an array";
        break;
      case Inside::kShot:
        wanted = *member_ == kRangeMember ? "a number" : "an array of three numbers";
        break;
      case Inside::kVector:
        wanted = "a number";
        break;
    }
    const std::string where = subject();
    refuse(chars_.place(),
           fmt::format("{} is {}, not {}", where.empty() ? "the file" : where, what, wanted));
  }

  [[noreturn]] static void refuse(Place place, std::string_view why) {
    throw Error(ErrorId::kShotFileInvalid, "{}:{}: {}", place.line, place.column, why);
  }

  CountedChars& chars_;
  std::vector<grisaille_shot> shots_;
  Inside inside_ = Inside::kNothing;
  std::array<bool, kFileMembers.size()> fileMembers_{};
  std::array<bool, kShotMembers.size()> shotMembers_{};
  std::optional<size_t> member_;  // of the innermost object; within it after its first key
  ShotValues values_;
  size_t index_ = 0;  // of the vector's next number
  Place shotPlace_;
};

using Text = fmt::memory_buffer;

void put(Text& text, double value) {
  // JSON's "-0" is a whole number, which has no sign once it is read.
  if (value == 0 && std::signbit(value)) {
    text.append(std::string_view("-0.0"));
  } else {
    fmt::format_to(std::back_inserter(text), "{}", value);
  }
}

// The fewest digits that lead back to the float by way of a double. The float's own fewest do so
// for all floats up to 1e6 but one, 0x1.21fc7ap-84, whose digits round to the half between two.
void put(Text& text, float value) {
  const size_t start = text.size();
  if (value == 0) {
    put(text, double{value});
    return;
  }
  fmt::format_to(std::back_inserter(text), "{}", value);
  double back = 0;
  std::from_chars(text.begin() + start, text.end(), back);
  if (static_cast<float>(back) == value) return;
  text.resize(start);
  put(text, double{value});
}

template <typename T>
void putVector(Text& text, std::string_view name, const T (&vector)[3]) {
  fmt::format_to(std::back_inserter(text), "\"{}\": [", name);
  for (size_t i = 0; i < 3; ++i) {
    if (i > 0) text.append(std::string_view(", "));
    put(text, vector[i]);
  }
  text.push_back(']');
}

}  // namespace

void writeJson(std::span<const grisaille_shot> shots, std::ostream& out) {
  Text text;
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  fmt::format_to(std::back_inserter(text), "{{\"version\": {}, \"shots\": [", kJsonVersion);
  for (const grisaille_shot& shot : shots) {
    text.append(std::string_view(&shot == shots.data() ? "\n{" : ",\n{"));
    putVector(text, "origin", shot.origin);
    text.append(std::string_view(", "));
    putVector(text, "direction", shot.direction);
    text.append(std::string_view(", "));
    putVector(text, "color", shot.color);
    if (shot.range != 0) {
      text.append(std::string_view(", \"range\": "));
      put(text, shot.range);
    }
    text.push_back('}');
    if (text.size() >= kChunk) flush();
  }
  text.append(std::string_view("\n]}\n"));
  flush();
}

std::vector<grisaille_shot> readJson(std::istream& in) {
  CountedChars chars(in);
  Handler handler(chars);
  json::sax_parse(CharIterator{&chars}, CharIterator{}, &handler);
  return handler.take();
}

}  // namespace grisaille::shots
