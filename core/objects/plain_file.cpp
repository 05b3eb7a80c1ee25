// SPDX-License-Identifier: MIT
#include "core/objects/plain_file.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace grisaille::objects {
namespace {

// An object longer than kLongest may be cut by the end of the buffer; the file is then not plain.
constexpr size_t kBuffer = size_t{4} << 20;
constexpr size_t kLongest = size_t{64} << 10;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// Each function reads one part and returns false if the text continues in another way.
class PlainReader {
 public:
  // `file`: null, or continues the text; `bytes`: its size.
  PlainReader(const Table& table, std::string_view text, std::istream* file, uintmax_t bytes)
      : text_(text),
        file_(file),
        bytes_(bytes),
        objects_(table),
        blank_(table),
        object_(table),
        given_(table.field_count) {
    for (const Field& field : fieldsOf(table)) keys_.emplace_back(field.key);
  }

  std::optional<Objects> read() {
    double version = 0;
    refill();
    const bool good = take('{') && takeKey("version") && takeNumber(version) && version == 1 &&
                      take(',') && takeKey(table().key) && take('[') && takeObjects() &&
                      take('}') && !skipSpace();
    if (!good) return std::nullopt;
    return std::move(objects_);
  }

 private:
  const Table& table() const { return objects_.table(); }

  // Reads on before the text in memory ends.
  void refill() {
    if (file_ == nullptr || text_.size() - at_ > kLongest) return;
    std::string rest(text_.substr(at_));
    const size_t held = rest.size();
    buffer_.resize(kBuffer);
    std::ranges::copy(rest, buffer_.begin());
    file_->read(buffer_.data() + held, static_cast<std::streamsize>(kBuffer - held));
    const auto read = static_cast<size_t>(file_->gcount());
    if (read == 0) file_ = nullptr;
    text_ = std::string_view(buffer_).substr(0, held + read);
    passed_ += at_;
    at_ = 0;
    // The objects read so far tell how many the file holds.
    if (passed_ > 0 && passed_ < kBuffer + kLongest) {
      objects_.reserve(static_cast<size_t>(1.05 * static_cast<double>(objects_.size()) *
                                           static_cast<double>(bytes_) /
                                           static_cast<double>(passed_)));
    }
  }

  // Returns whether more text follows.
  bool skipSpace() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t')) {
      ++at_;
    }
    return at_ < text_.size();
  }

  bool take(char wanted) {
    if (!skipSpace() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  // `string`: the bytes between the quotes.
  bool takeString(std::string_view& string) {
    if (!take('"')) return false;
    const size_t end = text_.find('"', at_);
    if (end == std::string_view::npos) return false;
    string = text_.substr(at_, end - at_);
    at_ = end + 1;
    return string.find('\\') == std::string_view::npos;
  }

  bool takeKey(std::string_view wanted) {
    std::string_view key;
    return takeString(key) && key == wanted && take(':');
  }

  // std::from_chars() takes a few forms that JSON does not have: 01, 1., .5, inf.
  bool takeNumber(double& number) {
    if (!skipSpace()) return false;
    const char* const first = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const auto [last, status] = std::from_chars(first, end, number);
    if (status != std::errc()) return false;
    const char* const digits = first + (*first == '-' ? 1 : 0);
    if (!isDigit(*digits) || (*digits == '0' && digits + 1 < last && isDigit(digits[1]))) {
      return false;
    }
    const char* const point = std::find(digits, last, '.');
    if (point != last && (point + 1 == last || !isDigit(point[1]))) return false;
    at_ += static_cast<size_t>(last - first);
    return true;
  }

  bool takeValue(const Field& field, Value& value) {
    if (isText(field)) {
      std::string_view text;
      if (!takeString(text)) return false;
      value.text = text;
      return true;
    }
    auto& [x, y, z] = value.numbers;
    if (componentsOf(field) == 1) return takeNumber(x);
    return take('[') && takeNumber(x) && take(',') && takeNumber(y) && take(',') && takeNumber(z) &&
           take(']');
  }

  // `index`: where the search for the key begins. Files have the fields in the table's order.
  bool takeField(size_t& index) {
    std::string_view key;
    if (!takeString(key) || !take(':')) return false;
    for (size_t n = 0; keys_[index] != key; ++n) {
      if (n == keys_.size()) return false;
      index = (index + 1) % keys_.size();
    }
    if (given_[index]) return false;
    given_[index] = true;
    return takeValue(table().fields[index], object_.values[index]);
  }

  bool takeObject() {
    if (!take('{')) return false;
    given_.assign(keys_.size(), false);
    size_t index = 0;
    do {
      if (!takeField(index)) return false;
    } while (take(','));
    for (size_t i = 0; i < keys_.size(); ++i) {
      if (given_[i]) continue;
      if ((table().fields[i].flags & GRISAILLE_FIELD_REQUIRED) != 0) return false;
      object_.values[i] = blank_.values[i];
    }
    return take('}');
  }

  bool takeObjects() {
    if (take(']')) return true;
    do {
      refill();
      if (!takeObject()) return false;
      objects_.append(object_);
    } while (take(','));
    return take(']');
  }

  std::string_view text_;  // in memory: all, or a part of the file
  size_t at_ = 0;          // index of the next character
  std::istream* file_;     // null at the file's end
  const uintmax_t bytes_;
  uintmax_t passed_ = 0;  // bytes of the file before text_
  std::string buffer_;
  Objects objects_;
  const Object blank_;
  Object object_;  // the current object
  std::vector<bool> given_;
  std::vector<std::string_view> keys_;
};

std::optional<Objects> readAll(PlainReader reader) {
  try {
    return reader.read();
  } catch (const Error&) {  // a value is out of range
    return std::nullopt;
  }
}

}  // namespace

std::optional<Objects> readPlainFile(const Table& table, std::string_view text) {
  return readAll({table, text, nullptr, text.size()});
}

std::optional<Objects> readPlainFile(const Table& table, std::istream& file, uintmax_t bytes) {
  return readAll({table, {}, &file, bytes});
}

}  // namespace grisaille::objects
