// SPDX-License-Identifier: MIT
// Plugin descriptions: a valid one, and bytes that select fields and their new values. Pointers
// always point to valid memory, since a host cannot check them, and lists have the stated length.
#include <algorithm>
#include <cstring>
#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/effect/struct_version.h"
#include "core/objects/object_file.h"
#include "tests/fuzz/check_values.h"
#include "tests/fuzz/table.h"

namespace grisaille::fuzz {
namespace {

// Reads numbers and texts from the bytes; returns zeros and "" at the end.
class Source {
 public:
  explicit Source(std::string_view bytes) : rest_(bytes) {}
  bool ended() const { return rest_.empty(); }
  template <typename T>
  T number() {
    T value{};
    const size_t size = std::min(sizeof value, rest_.size());
    if (size > 0) std::memcpy(&value, rest_.data(), size);
    rest_.remove_prefix(size);
    return value;
  }
  uint32_t below(size_t count) { return number<uint8_t>() % static_cast<uint32_t>(count); }
  std::string_view text() { return cut(rest_, '\0'); }

 private:
  std::string_view rest_;
};

// Above every limit on a count, to test lists that are too long as well.
constexpr size_t kMost = 260;

// KEY0, KEY1, ...: created once.
std::vector<std::string> keysOf(char letter) {
  std::vector<std::string> keys;
  for (size_t i = 0; i < kMost; ++i) keys.push_back(fmt::format("{}{}", letter, i));
  return keys;
}

struct Effect {
  std::vector<grisaille_param_desc> params;
  std::vector<grisaille_output_desc> outputs;
  std::vector<grisaille_field_desc> fields;
  grisaille_object_desc objects = kObjects;
  grisaille_effect_desc desc = kEffect;
};

// Requires that the table's texts can be written as JSON, which refuses invalid UTF-8.
void requireTexts(const effect::Effect& effect) {
  nlohmann::json texts = {effect.desc->label, effect.desc->version, effect.desc->tooltip};
  for (const grisaille_param_desc& param : effect.params()) {
    texts.insert(texts.end(), {param.key, param.label, param.unit, param.tooltip});
    for (uint32_t i = 0; i < param.enum_count; ++i) texts.push_back(param.enum_labels[i]);
  }
  for (const grisaille_output_desc& output : effect.outputs()) texts.push_back(output.tooltip);
  require(texts.dump().find('\n') == std::string::npos);
}

// Requires that an object of an accepted table works: its defaults are valid and survive writing
// and reading.
void requireUsable(const grisaille_object_desc& table) {
  nlohmann::json texts = {table.label, table.tooltip};
  for (const grisaille_field_desc& field : objects::fieldsOf(table)) {
    texts.insert(texts.end(), {field.key, field.label, field.unit, field.tooltip});
  }
  require(texts.dump().find('\n') == std::string::npos);
  objects::Objects all(table);
  all.append(objects::Object(table));
  const auto file = nlohmann::json::parse(objects::jsonOf(all.view()));
  objects::Objects again(table);
  again.append(objects::parseObject(table, file[table.key][0].dump()));
  require(again.view().object(0) == all.view().object(0));
}

class Plugin {
 public:
  explicit Plugin(Source source) : source_(source), effects_(2) {
    for (Effect& effect : effects_) fill(effect);
    effects_[1].desc.key = "second";
    while (!source_.ended()) change();
  }

  void check() {
    std::vector<const grisaille_effect_desc*> all;
    for (size_t i = 0; i < kMost; ++i) {
      all.push_back(i == absent_ ? nullptr : &effects_[i % effects_.size()].desc);
    }
    desc_.effects = hasEffects_ ? all.data() : nullptr;
    if (!accepted({ErrorId::kPluginTable}, [&] { effect::checkTable(desc_); })) return;
    for (uint32_t i = 0; i < desc_.effect_count; ++i) {
      const grisaille_effect_desc desc = effect::whole(all[i]);
      const effect::Effect effect{.desc = &desc, .path = ""};
      requireSound(effect::Values(effect));
      requireTexts(effect);
      effect.reads(nullptr, 1);
      effect.guardBand(nullptr);
      if (effect.objects() != nullptr) requireUsable(*effect.objects());
    }
  }

 private:
  void fill(Effect& effect) {
    static const std::vector<std::string> params = keysOf('p'), outputs = keysOf('o');
    for (size_t i = 0; i < kMost; ++i) {
      effect.params.push_back(kParams[i % kParams.size()]);
      effect.outputs.push_back(kOutputs[i % kOutputs.size()]);
      if (i >= kParams.size()) effect.params.back().key = params[i].c_str();
      if (i >= kOutputs.size()) effect.outputs.back().key = outputs[i].c_str();
    }
    effect.desc.params = effect.params.data();
    effect.desc.outputs = effect.outputs.data();
    static const std::vector<std::string> fields = keysOf('f');
    for (size_t i = 0; i < kMost; ++i) {
      effect.fields.push_back(kFields[i % kFields.size()]);
      if (i >= kFields.size()) effect.fields.back().key = fields[i].c_str();
    }
    effect.objects.fields = effect.fields.data();
    effect.desc.objects = &effect.objects;
  }

  void change() {
    Effect& effect = effects_[source_.below(2)];
    switch (source_.below(6)) {
      case 0:
        return changePlugin();
      case 4:
        return changeObjects(effect);
      case 5:
        return changeField(effect.fields[source_.below(kFields.size() + 1)]);
      case 1:
        return changeEffect(effect);
      case 2:
        return changeParam(effect.params[source_.below(kParams.size() + 1)]);
      default:
        return changeOutput(effect.outputs[source_.below(kOutputs.size() + 1)]);
    }
  }

  void changePlugin() {
    switch (source_.below(5)) {
      case 0:
        return take(desc_.struct_size);
      case 1:
        return take(desc_.effect_count);
      case 2:
        return take(desc_.reserved);
      case 3:
        absent_ = source_.below(4);
        return;
      default:
        hasEffects_ = !hasEffects_;
    }
  }

  void changeEffect(Effect& effect) {
    grisaille_effect_desc& desc = effect.desc;
    uint32_t* const words[] = {&desc.struct_size, &desc.param_count, &desc.output_count,
                               &desc.flags};
    const char** const texts[] = {&desc.key, &desc.label, &desc.version, &desc.tooltip};
    switch (source_.below(8)) {
      case 0:
      case 1:
        return take(*words[source_.below(std::size(words))]);
      case 2:
      case 3:
        return take(*texts[source_.below(std::size(texts))]);
      case 4:
        desc.params = desc.params == nullptr ? effect.params.data() : nullptr;
        return;
      case 5:
        desc.outputs = desc.outputs == nullptr ? effect.outputs.data() : nullptr;
        return;
      case 6:
        desc.objects = desc.objects == nullptr ? &effect.objects : nullptr;
        return;
      default:
        return dropFunction(desc);
    }
  }

  void dropFunction(grisaille_effect_desc& desc) {
    switch (source_.below(4)) {
      case 0:
        desc.reads = nullptr;
        return;
      case 1:
        desc.create = nullptr;
        return;
      case 2:
        desc.record = nullptr;
        return;
      default:
        desc.destroy = nullptr;
    }
  }

  void changeParam(grisaille_param_desc& param) {
    uint32_t* const words[] = {&param.struct_size, &param.type, &param.flags};
    const char** const texts[] = {&param.key, &param.label, &param.unit, &param.tooltip};
    double* const numbers[] = {&param.hard_min, &param.hard_max,      &param.soft_min,
                               &param.soft_max, &param.default_value, &param.step};
    switch (source_.below(6)) {
      case 0:
        return take(*words[source_.below(std::size(words))]);
      case 1:
        return take(*texts[source_.below(std::size(texts))]);
      case 2:
      case 3:
        *numbers[source_.below(std::size(numbers))] = number();
        return;
      case 4:
        return makeEnum(param);
      default:
        param = kParams[source_.below(kParams.size())];
        param.key = "other";
    }
  }

  void changeObjects(Effect& effect) {
    grisaille_object_desc& desc = effect.objects;
    uint32_t* const words[] = {&desc.struct_size, &desc.object_size, &desc.field_count,
                               &desc.placement,   &desc.point_field, &desc.direction_field};
    const char** const texts[] = {&desc.key, &desc.label, &desc.tooltip};
    switch (source_.below(3)) {
      case 0:
        return take(*words[source_.below(std::size(words))]);
      case 1:
        return take(*texts[source_.below(std::size(texts))]);
      default:
        desc.fields = desc.fields == nullptr ? effect.fields.data() : nullptr;
    }
  }

  void changeField(grisaille_field_desc& field) {
    uint32_t* const words[] = {&field.struct_size, &field.type, &field.flags, &field.offset};
    const char** const texts[] = {&field.key, &field.label, &field.unit, &field.tooltip,
                                  &field.default_text};
    double* const numbers[] = {&field.min, &field.max, &field.default_value[0],
                               &field.default_value[1], &field.default_value[2]};
    switch (source_.below(4)) {
      case 0:
        return take(*words[source_.below(std::size(words))]);
      case 1:
        return take(*texts[source_.below(std::size(texts))]);
      case 2:
        *numbers[source_.below(std::size(numbers))] = number();
        return;
      default:
        field = kFields[source_.below(kFields.size())];
        field.key = "other";
    }
  }

  // Any number, or one that is more likely to be valid.
  double number() {
    switch (source_.below(3)) {
      case 0:
        return source_.number<double>();
      case 1:
        return source_.number<int32_t>();
      default:
        return source_.number<int8_t>();
    }
  }

  void makeEnum(grisaille_param_desc& param) {
    param.type = GRISAILLE_PARAM_ENUM;
    param.enum_count = source_.below(70);
    param.hard_max = param.soft_max = param.enum_count - 1.0;
    param.hard_min = param.soft_min = param.default_value = 0;
    static const std::vector<std::string> entries = keysOf('e');
    std::vector<const char*>& keys = lists_.emplace_back();
    for (uint32_t i = 0; i < 70; ++i) keys.push_back(entries[i].c_str());
    const uint32_t changed = source_.below(70);
    take(keys[changed]);
    param.enum_keys = keys.data();
    param.enum_labels = source_.below(8) == 0 ? nullptr : keys.data();
  }

  void changeOutput(grisaille_output_desc& output) {
    switch (source_.below(5)) {
      case 0:
        return take(output.struct_size);
      case 1:
        return take(output.key);
      case 2:
        return take(output.tooltip);
      case 3:
        output.format = source_.below(12);
        return;
      default:
        output.role = source_.below(8);
    }
  }

  // A small number, which is more likely to be valid, or any number.
  void take(uint32_t& word) {
    word = source_.below(2) == 0 ? source_.number<uint8_t>() : source_.number<uint32_t>();
  }
  void take(const char*& text) {
    text = source_.below(8) == 0 ? nullptr : kept(std::string(source_.text()));
  }
  const char* kept(const std::string& text) { return texts_.emplace_back(text).c_str(); }

  Source source_;
  std::deque<std::string> texts_;
  std::deque<std::vector<const char*>> lists_;
  std::vector<Effect> effects_;
  size_t absent_ = kMost;
  bool hasEffects_ = true;
  grisaille_plugin_desc desc_ = {.magic = GRISAILLE_MAGIC,
                                 .abi_major = GRISAILLE_ABI_MAJOR,
                                 .abi_minor = GRISAILLE_ABI_MINOR,
                                 .struct_size = sizeof(grisaille_plugin_desc),
                                 .effect_count = 2,
                                 .reserved = 0,
                                 .effects = nullptr};
};

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  fuzz::Plugin(fuzz::Source(fuzz::textOf(data, size))).check();
  return 0;
}
