// SPDX-License-Identifier: MIT
// Writes docs/api.md from C headers: what stands in their comments, by function and by field.
//   grisaille_api_page HEADER... > PAGE
// It knows C as these headers write it: includes and guards, macros of one line, opaque types,
// enums, structs, functions that begin with GRISAILLE_EXPORT.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace grisaille {
namespace {

std::string squeezed(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) {
      result += c;
    } else if (!result.empty() && result.back() != ' ') {
      result += ' ';
    }
  }
  if (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

// A comment's text as paragraphs of one line each.
std::vector<std::string> paragraphsOf(std::string_view comment) {
  std::vector<std::string> paragraphs(1);
  comment = comment.substr(2, comment.size() - 4);
  while (!comment.empty()) {
    const size_t end = std::min(comment.find('\n'), comment.size());
    std::string line = squeezed(comment.substr(0, end));
    comment.remove_prefix(std::min(end + 1, comment.size()));
    if (line.starts_with('*')) line = squeezed(std::string_view(line).substr(1));
    if (line.starts_with(' ')) line.erase(0, 1);
    if (line.empty()) {
      if (!paragraphs.back().empty()) paragraphs.emplace_back();
    } else {
      paragraphs.back() += (paragraphs.back().empty() ? "" : " ") + line;
    }
  }
  if (paragraphs.back().empty()) paragraphs.pop_back();
  return paragraphs;
}

std::string joined(const std::vector<std::string>& paragraphs, const char* between) {
  return fmt::format("{}", fmt::join(paragraphs, between));
}

// A piece of C up to its `;`, `,` or body, with the comments before, inside and right after it.
struct Statement {
  std::string code;  // squeezed, without comments
  std::string body;  // between its braces, if it has any
  std::vector<std::string> before, about;
};

class Reader {
 public:
  Reader(std::string_view text, char end) : text_(text), end_(end) {}

  bool next(Statement& statement) {
    statement = {};
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (text_.substr(at_, 2) == "/*") {
        const std::string comment = takeComment();
        auto& to = squeezed(statement.code).empty() ? statement.before : statement.about;
        for (std::string& one : paragraphsOf(comment)) to.push_back(std::move(one));
      } else if (c == '{') {
        statement.body = takeBody();
      } else if (c == end_ || c == ';') {
        ++at_;
        takeTrailing(statement);
        statement.code = squeezed(statement.code);
        return true;
      } else {
        statement.code += c;
        ++at_;
      }
    }
    statement.code = squeezed(statement.code);
    return !statement.code.empty() || !statement.before.empty();
  }

 private:
  std::string takeComment() {
    const size_t end = text_.find("*/", at_) + 2;
    std::string comment(text_.substr(at_, end - at_));
    at_ = end;
    return comment;
  }
  std::string takeBody() {
    const size_t begin = ++at_;
    for (int depth = 1; depth > 0; ++at_) {
      if (text_[at_] == '{') ++depth;
      if (text_[at_] == '}') --depth;
    }
    return std::string(text_.substr(begin, at_ - 1 - begin));
  }
  // What begins on the line that the statement ends on is about it.
  void takeTrailing(Statement& statement) {
    const size_t found = text_.find_first_not_of(' ', at_);
    if (found == std::string_view::npos || text_.substr(found, 2) != "/*") return;
    at_ = found;
    for (std::string& one : paragraphsOf(takeComment())) statement.about.push_back(std::move(one));
  }

  std::string_view text_;
  char end_;
  size_t at_ = 0;
};

// As it stands, none of it Markdown's.
std::string plain(std::string text) {
  for (size_t at = 0; (at = text.find_first_of("|<", at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\\');
  }
  return text;
}

std::string about(const Statement& statement) {
  std::vector<std::string> all = statement.before;
  all.insert(all.end(), statement.about.begin(), statement.about.end());
  return plain(joined(all, " "));
}

// The comment before a declaration; what it says of errors on a line of its own.
std::string prose(const std::vector<std::string>& paragraphs) {
  std::string text;
  for (std::string one : paragraphs) {
    const size_t errors = one.find("Errors: ");
    if (errors != std::string::npos) {
      const size_t from = errors > 0 ? errors - 1 : 0;
      one.replace(from, errors + 8 - from,
                  (errors > 0 ? "\n\n" : "") + std::string("**Errors:** "));
    }
    text += plain(std::move(one)) + "\n\n";
  }
  return text;
}

class Page {
 public:
  void add(const std::string& name, std::string text) {
    // Conditional parts, guards and what C++ alone sees are no declarations.
    text = std::regex_replace(text, std::regex("#ifdef __cplusplus[^#]*#endif"), "");
    const size_t first = text.find("/*"), last = text.find("*/");
    page_ += "\n## `" + name + "`\n\n";
    std::vector<std::string> introduction = paragraphsOf(text.substr(first, last + 2 - first));
    introduction.erase(introduction.begin());  // the licence
    page_ += prose(introduction);
    macros(text);
    text = std::regex_replace(text.substr(last + 2), std::regex("(^|\n)#[^\n]*"), "\n");
    Reader reader(text, ';');
    for (Statement one; reader.next(one);) declaration(one);
  }

  std::string text() const { return page_; }

 private:
  void macros(const std::string& text) {
    const std::regex macro("#define (\\w+)(\\([^)]*\\))? ([^\n/]+)(/\\*(.*)\\*/)?");
    std::string rows;
    for (std::sregex_iterator match(text.begin(), text.end(), macro), end; match != end; ++match) {
      if ((*match)[1] == "GRISAILLE_EXPORT") continue;
      rows += fmt::format("| `{}{}` | `{}` | {} |\n", (*match)[1].str(), (*match)[2].str(),
                          squeezed((*match)[3].str()), squeezed((*match)[5].str()));
    }
    if (!rows.empty()) page_ += "| constant | value | |\n|---|---|---|\n" + rows + "\n";
  }

  void declaration(Statement& one) {
    std::vector<std::string> before;
    for (std::string& paragraph : one.before) {
      if (paragraph.starts_with("----")) {
        const size_t first = paragraph.find_first_not_of("- ");
        page_ += "### " + squeezed(paragraph.substr(first, paragraph.find(" ---", first) - first)) +
                 "\n\n";
      } else {
        before.push_back(std::move(paragraph));
      }
    }
    if (one.code.starts_with("typedef enum")) {
      heading(one.code.substr(one.code.rfind(' ') + 1), before);
      table(one.body, ',', "value", [](const std::string& code) { return "`" + code + "`"; });
    } else if (one.code.starts_with("typedef struct") && !one.body.empty()) {
      heading(one.code.substr(one.code.rfind(' ') + 1), before);
      table(one.body, ';', "field", [](const std::string& code) { return "`" + code + "`"; });
    } else if (one.code.starts_with("typedef struct")) {
      const std::string name = one.code.substr(one.code.rfind(' ') + 1);
      page_ += "#### `" + name + "`\n\nOpaque. " + prose(before);
    } else if (one.code.starts_with("GRISAILLE_EXPORT ")) {
      const std::string code = one.code.substr(std::string("GRISAILLE_EXPORT ").size());
      const size_t open = code.find('('), begin = code.rfind(' ', open) + 1;
      std::string name = code.substr(begin, open - begin);
      if (name.starts_with('*')) name.erase(0, 1);
      heading(name + "()", {});
      page_ += "```c\n" + code + ";\n```\n\n" + prose(before);
    } else if (!one.code.empty()) {
      throw std::runtime_error("what is this: " + one.code);
    }
  }

  void heading(const std::string& name, const std::vector<std::string>& before) {
    page_ += "#### `" + name + "`\n\n" + prose(before);
  }

  template <typename Code>
  void table(const std::string& body, char end, const char* first, Code&& code) {
    page_ += fmt::format("| {} | what it is |\n|---|---|\n", first);
    Reader reader(body, end);
    for (Statement one; reader.next(one);) {
      if (!one.code.empty()) page_ += "| " + code(one.code) + " | " + about(one) + " |\n";
    }
    page_ += "\n";
  }

  std::string page_;
};

// The errors that a page names by their numbers.
std::string errorsOf(const std::string& page) {
  std::set<int> named;
  const std::regex number("\\b[1-9][0-9]{3}\\b");
  for (std::sregex_iterator match(page.begin(), page.end(), number), end; match != end; ++match) {
    named.insert(std::stoi(match->str()));
  }
  std::string rows;
  const auto row = [&](int id, std::string_view remedy) {
    if (named.contains(id)) rows += fmt::format("| {} | {} |\n", id, remedy);
  };
#define GRISAILLE_ERROR(name, id, remedy) row(id, remedy);
#include "core/base/error_list.h"
#undef GRISAILLE_ERROR
  return "\n## Errors\n\nThose that the functions above name.\n\n| number | what to do "
         "|\n|---|---|\n" +
         rows;
}

void run(int count, char** arguments) {
  Page page;
  for (int i = 1; i < count; ++i) {
    const std::filesystem::path path = arguments[i];
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file || text.empty()) throw std::runtime_error("cannot read " + path.string());
    page.add("grisaille/" + path.filename().string(), std::move(text));
  }
  fmt::print(
      "# The C interfaces\n\n`./dev api` makes this page of the comments in the headers; their C++ "
      "wrappers, [host.hpp](../host/include/grisaille/host.hpp) and "
      "[effect.hpp](../core/effect/include/grisaille/effect.hpp), add nothing to what stands "
      "here.\n{}{}",
      page.text(), errorsOf(page.text()));
}

}  // namespace
}  // namespace grisaille

int main(int count, char** arguments) {
  try {
    grisaille::run(count, arguments);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
