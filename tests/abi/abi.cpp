// SPDX-License-Identifier: MIT
#include "tests/abi/abi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

using nlohmann::json;

std::string run(const std::string& command, const TemporaryFolder& folder) {
  const Outcome outcome = runShell(command, folder.path());
  if (outcome.status != 0) throw std::runtime_error(command + "\n" + outcome.err);
  return outcome.out;
}

// A C statement that prints one line of the table.
std::string print(const std::string& name, const std::string& format, const std::string& values) {
  return fmt::format("  printf(\"{}: {}\\n\"{});\n", name, format, values);
}

std::string typeOf(const json& node) {
  return node.at("type").at("qualType");
}

// The statements for one declaration; "" for a declaration that has no layout.
std::string statementsOf(const json& node) {
  const std::string kind = node.at("kind"), name = node.value("name", "");
  if (!name.starts_with("grisaille_")) return "";
  std::string text;
  if (kind == "FunctionDecl") return print(name, typeOf(node), "");
  if (kind == "TypedefDecl") {
    const std::string type = typeOf(node);
    // A struct or an enum of the same name has lines of its own.
    return type == "struct " + name || type == "enum " + name ? "" : print(name, type, "");
  }
  if (kind == "RecordDecl" && node.value("completeDefinition", false)) {
    text = print(name, "%zu bytes", fmt::format(", sizeof({})", name));
  }
  for (const json& inner : node.value("inner", json::array())) {
    const std::string member = inner.value("name", "");
    if (inner.at("kind") == "FieldDecl") {
      text += print(name + "." + member, "at %zu, %zu bytes, " + typeOf(inner),
                    fmt::format(", offsetof({0}, {1}), sizeof((({0}*)0)->{1})", name, member));
    } else if (inner.at("kind") == "EnumConstantDecl") {
      text += print(member, "%d of " + name, ", (int)" + member);
    }
  }
  return text;
}

// The macros with a value, except those for one compiler.
std::string constantsOf(const std::string& macros) {
  std::istringstream lines(macros);
  std::string table;
  for (std::string line; std::getline(lines, line);) {
    constexpr const char* kStart = "#define ";
    if (!line.starts_with(std::string(kStart) + "GRISAILLE_")) continue;
    const size_t start = std::strlen(kStart), end = line.find_first_of(" (", start);
    if (end == std::string::npos || line.find("__attribute__") != std::string::npos) continue;
    const size_t text = line[end] == '(' ? end : end + 1;
    if (text < line.size()) {
      table += line.substr(start, end - start) + ": " + line.substr(text) + "\n";
    }
  }
  return table;
}

using Table = std::map<std::string, std::string>;

Table tableOf(const std::string& text) {
  Table table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const size_t colon = line.find(": ");
    if (colon != std::string::npos) table[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return table;
}

std::string structOf(const std::string& name) {
  return name.substr(0, name.find('.'));
}
bool isMember(const std::string& name) {
  return name.find('.') != std::string::npos;
}

// The first number of a text: the size of a struct, the offset of a member, or a constant.
long numberIn(const std::string& text) {
  const size_t digit = text.find_first_of("0123456789");
  return digit == std::string::npos ? 0 : std::strtol(text.c_str() + digit, nullptr, 0);
}

bool mayRise(const std::string& name) {
  return name.ends_with("_COUNT") || name.ends_with("_MINOR") || name.ends_with("_VERSION");
}

bool isSize(const std::string& name, const std::string& text) {
  return !isMember(name) && text.ends_with(" bytes");
}

// Whether programs that were built before still fit after this change.
bool fits(const Table& before, const std::string& name, const std::string& now) {
  const std::string owner = structOf(name);
  const bool sized = before.contains(owner + ".struct_size");
  const auto old = before.find(name);
  if (old == before.end()) {
    // A program sets the padding at the end of its struct to anything: a member must lie beyond it.
    return !isMember(name) || !before.contains(owner) ||
           (sized && numberIn(now) >= numberIn(before.at(owner)));
  }
  const bool rises = numberIn(now) > numberIn(old->second);
  return rises && (mayRise(name) || (isSize(name, now) && sized));
}

}  // namespace

std::string abiTable(const std::string& includes, const std::string& options) {
  const TemporaryFolder folder;
  folder.write("headers.c", includes);
  const std::string clang = "clang -x c -std=c99 " + options + " headers.c ";
  const json tree = json::parse(run(clang + "-fsyntax-only -Xclang -ast-dump=json", folder));
  std::string program =
      "#include <stddef.h>\n#include <stdio.h>\n" + includes + "int main(void) {\n";
  for (const json& node : tree.at("inner")) program += statementsOf(node);
  folder.write("print.c", program + "  return 0;\n}\n");
  return constantsOf(run(clang + "-E -dM | sort", folder)) +
         run("cc -std=c99 " + options + " print.c -o print && ./print", folder);
}

AbiChanges abiChanges(const std::string& before, const std::string& after) {
  const Table then = tableOf(before), now = tableOf(after);
  AbiChanges changes;
  for (const auto& [name, text] : then) {
    if (!now.contains(name)) changes.breaks.push_back(name + " is gone; it was " + text);
  }
  for (const auto& [name, text] : now) {
    const auto old = then.find(name);
    if (old != then.end() && old->second == text) continue;
    std::vector<std::string>& list = fits(then, name, text) ? changes.grows : changes.breaks;
    list.push_back(old == then.end() ? name + " is new: " + text
                                     : name + " was " + old->second + ", and is " + text);
  }
  return changes;
}

}  // namespace grisaille::tests
