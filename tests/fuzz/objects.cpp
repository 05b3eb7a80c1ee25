// SPDX-License-Identifier: MIT
// Object files, and single objects in the form of the command line.
#include "core/objects/object_file.h"
#include "core/objects/plain_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/table.h"

namespace grisaille::fuzz {
namespace {

void requireSame(const objects::View& a, const objects::View& b) {
  require(a.count == b.count);
  for (size_t i = 0; i < a.count; ++i) require(a.object(i) == b.object(i));
}

// Requires that loaded objects are valid, and that writing and loading them again changes nothing.
void requireSound(const objects::View& view) {
  objects::Objects again(kObjects);
  again.append(view);
  requireSame(again.view(), view);
  const std::string path = scratchFile("again.json", objects::jsonOf(view));
  requireSame(objects::load(kObjects, path).view(), view);
}

void checkFile(std::string_view text) {
  objects::Objects all(kObjects);
  const std::string path = scratchFile("objects.json", text);
  const bool good = accepted({ErrorId::kObjectFileInvalid, ErrorId::kObjectFileVersion},
                             [&] { all = objects::load(kObjects, path); });
  if (good) requireSound(all.view());
  // The fast reader reads no other objects than the general one, which alone takes a byte order
  // mark.
  const std::optional<objects::Objects> plain = objects::readPlainFile(kObjects, text);
  if (plain) {
    requireSame(objects::parse(kObjects, "\xEF\xBB\xBF" + std::string(text), "text").view(),
                plain->view());
  }
}

void checkOne(std::string_view text) {
  objects::Object one(kObjects);
  const bool good =
      accepted({ErrorId::kObjectField}, [&] { one = objects::parseObject(kObjects, text); });
  if (!good) return;
  objects::Objects all(kObjects);
  all.append(one);
  requireSound(all.view());
}

// A field of the command line's --add, for example "range=0.5".
void checkField(std::string_view text) {
  const std::string_view key = cut(text, '=');
  objects::Value value;
  const objects::Field* field = nullptr;
  const bool good = accepted({ErrorId::kObjectField}, [&] {
    field = &objects::fieldOf(kObjects, key);
    value = objects::parseValue(*field, text);
  });
  if (!good) return;
  const std::string printed = objects::textOf(*field, value);
  require(objects::textOf(*field, objects::parseValue(*field, printed)) == printed);
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  const std::string_view text = fuzz::textOf(data, size);
  fuzz::checkFile(text);
  fuzz::checkOne(text);
  fuzz::checkField(text);
  return 0;
}
