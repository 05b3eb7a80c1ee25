// SPDX-License-Identifier: MIT
// shader_compiler FILE.spv NAME STEM: writes STEM.c and STEM.h with the grisaille_shader of one
// stage: its SPIR-V without source text, its GLSL 4.50 and its reflection. For a shader that the
// layer does not support, prints one line and exits with status 1.
#include <fmt/format.h>
#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr unsigned kSlotsPerClass = 16;

template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print(stderr, "shader_compiler: {}\n", fmt::format(format, std::forward<Args>(args)...));
  std::exit(1);
}

void check(spvc_context context, spvc_result result) {
  if (result != SPVC_SUCCESS) fail("{}", spvc_context_get_last_error_string(context));
}

std::vector<SpvId> readWords(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() < 20 || bytes.size() % 4 != 0) fail("{} is not SPIR-V", path);
  std::vector<SpvId> words(bytes.size() / 4);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(words.data()));
  return words;
}

// Removes source text, line numbers and processing notes, which contain paths of the build machine.
// Keeps names, for debuggers.
std::vector<SpvId> withoutSource(const std::vector<SpvId>& words) {
  std::vector<SpvId> kept(words.begin(), words.begin() + 5);
  for (size_t i = 5; i < words.size();) {
    const unsigned op = words[i] & 0xffffu;
    const size_t length = words[i] >> 16;
    if (length == 0 || i + length > words.size()) fail("broken SPIR-V at word {}", i);
    const bool source = op == SpvOpSource || op == SpvOpSourceContinued || op == SpvOpString ||
                        op == SpvOpSourceExtension || op == SpvOpLine || op == SpvOpNoLine ||
                        op == SpvOpModuleProcessed;
    if (!source) kept.insert(kept.end(), words.begin() + i, words.begin() + i + length);
    i += length;
  }
  return kept;
}

const char* imageFormatName(SpvImageFormat format) {
  switch (format) {
    case SpvImageFormatR8:
      return "r8";
    case SpvImageFormatRgba8:
      return "rgba8";
    case SpvImageFormatR16f:
      return "r16f";
    case SpvImageFormatRgba16f:
      return "rgba16f";
    case SpvImageFormatR32f:
      return "r32f";
    case SpvImageFormatRg32f:
      return "rg32f";
    case SpvImageFormatRgba32f:
      return "rgba32f";
    case SpvImageFormatR32ui:
      return "r32ui";
    default:
      return nullptr;
  }
}

// The grisaille_scalar of a type.
unsigned scalarOf(spvc_type type, std::string_view what) {
  switch (spvc_type_get_basetype(type)) {
    case SPVC_BASETYPE_UINT32:
      return 0;
    case SPVC_BASETYPE_INT32:
      return 1;
    case SPVC_BASETYPE_FP32:
      return 2;
    case SPVC_BASETYPE_BOOLEAN:
      return 3;
    default:
      fail("{} has a type other than uint, int, float or bool", what);
  }
}

class Reflection {
 public:
  Reflection(spvc_context context, spvc_compiler compiler, std::string name)
      : context_(context), compiler_(compiler), name_(std::move(name)) {
    check(context_, spvc_compiler_create_shader_resources(compiler_, &resources_));
  }

  // Reads every slot and, for the GLSL, renumbers it within its class.
  void slots() {
    resourceSlots(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, 0);
    resourceSlots(SPVC_RESOURCE_TYPE_STORAGE_BUFFER, 1);
    resourceSlots(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, 2);
    resourceSlots(SPVC_RESOURCE_TYPE_STORAGE_IMAGE, 3);
    for (const auto type : {SPVC_RESOURCE_TYPE_PUSH_CONSTANT, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE,
                            SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, SPVC_RESOURCE_TYPE_SUBPASS_INPUT,
                            SPVC_RESOURCE_TYPE_ATOMIC_COUNTER}) {
      const auto [list, count] = resources(type);
      if (count > 0) fail("{}: {} is of a kind that the layer does not have", name_, list[0].name);
    }
  }

  void constants() {
    const spvc_specialization_constant* list = nullptr;
    size_t count = 0;
    check(context_, spvc_compiler_get_specialization_constants(compiler_, &list, &count));
    for (size_t i = 0; i < count; ++i) {
      const spvc_constant constant = spvc_compiler_get_constant_handle(compiler_, list[i].id);
      const spvc_type type =
          spvc_compiler_get_type_handle(compiler_, spvc_constant_get_type(constant));
      const char* label = spvc_compiler_get_name(compiler_, list[i].id);
      constants_ +=
          fmt::format("    {{{}u, {}u, {:#x}u, \"{}\"}},\n", list[i].constant_id,
                      scalarOf(type, label), spvc_constant_get_scalar_u32(constant, 0, 0), label);
      ++constantCount_;
    }
  }

  // Vertex inputs or fragment outputs.
  unsigned locations(spvc_resource_type type, std::string& rows) {
    const auto [list, count] = resources(type);
    std::map<unsigned, std::string> sorted;
    for (size_t i = 0; i < count; ++i) {
      const spvc_type handle = spvc_compiler_get_type_handle(compiler_, list[i].type_id);
      const unsigned location =
          spvc_compiler_get_decoration(compiler_, list[i].id, SpvDecorationLocation);
      sorted[location] =
          fmt::format("    {{{}u, {}u, {}u, \"{}\"}},\n", location, scalarOf(handle, list[i].name),
                      spvc_type_get_vector_size(handle), list[i].name);
    }
    for (const auto& [location, row] : sorted) rows += row;
    return static_cast<unsigned>(sorted.size());
  }

  const std::string& slotRows() const { return slots_; }
  unsigned slotCount() const { return static_cast<unsigned>(used_.size()); }
  const std::string& constantRows() const { return constants_; }
  unsigned constantCount() const { return constantCount_; }
  const std::string& blockChecks() const { return checks_; }

 private:
  struct List {
    const spvc_reflected_resource* items = nullptr;
    size_t count = 0;
  };

  List resources(spvc_resource_type type) {
    List list;
    check(context_,
          spvc_resources_get_resource_list_for_type(resources_, type, &list.items, &list.count));
    return list;
  }

  void resourceSlots(spvc_resource_type type, unsigned slotClass) {
    const auto [list, count] = resources(type);
    for (size_t i = 0; i < count; ++i) slot(list[i], slotClass);
  }

  void slot(const spvc_reflected_resource& resource, unsigned slotClass) {
    const spvc_type type = spvc_compiler_get_type_handle(compiler_, resource.type_id);
    const unsigned set =
        spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationDescriptorSet);
    const unsigned binding =
        spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationBinding);
    static constexpr const char* kMacros[] = {"UNIFORM", "STORAGE", "TEXTURE", "IMAGE"};
    if (set != 0 || binding / kSlotsPerClass != slotClass) {
      fail("{}: {} is at set {} binding {}; write layout({}(n)) with n from 0 to 15", name_,
           resource.name, set, binding, kMacros[slotClass]);
    }
    if (!used_.insert(binding).second) {
      fail("{}: two resources share {}({})", name_, kMacros[slotClass], binding % kSlotsPerClass);
    }
    if (spvc_type_get_num_array_dimensions(type) != 0) {
      fail("{}: {} is an array of resources", name_, resource.name);
    }
    const unsigned number = binding % kSlotsPerClass;
    spvc_compiler_set_decoration(compiler_, resource.id, SpvDecorationBinding, number);

    const bool storage = slotClass == 1 || slotClass == 3;
    const unsigned reads = storage && decorated(resource, type, SpvDecorationNonReadable) ? 0 : 1;
    const unsigned writes = storage && !decorated(resource, type, SpvDecorationNonWritable) ? 1 : 0;
    size_t blockSize = 0;
    unsigned arrayed = 0;
    const char* format = "";
    const char* label = resource.name;
    if (slotClass <= 1) {
      const spvc_type block = spvc_compiler_get_type_handle(compiler_, resource.base_type_id);
      check(context_, spvc_compiler_get_declared_struct_size(compiler_, block, &blockSize));
      if (slotClass == 0) blockCheck(resource, block, blockSize);
    } else {
      if (spvc_type_get_image_dimension(type) != SpvDim2D) {
        fail("{}: {} is not a 2D texture or image", name_, label);
      }
      arrayed = spvc_type_get_image_arrayed(type) ? 1 : 0;
    }
    if (slotClass == 3) {
      format = imageFormatName(spvc_type_get_image_storage_format(type));
      if (format == nullptr) fail("{}: {} has an image format the layer lacks", name_, label);
    }
    slots_ += fmt::format("    {{{}u, {}u, {}u, {}u, {}u, {}u, \"{}\", \"{}\"}},\n", slotClass,
                          number, reads, writes, blockSize, arrayed, format, label);
  }

  // Whether the resource is readonly or writeonly. SPIR-V decorates the variable of an image, and
  // the variable or every member of a storage block.
  bool decorated(const spvc_reflected_resource& resource, spvc_type type,
                 SpvDecoration decoration) {
    if (spvc_compiler_has_decoration(compiler_, resource.id, decoration)) return true;
    if (spvc_type_get_basetype(type) != SPVC_BASETYPE_STRUCT) return false;
    const unsigned members = spvc_type_get_num_member_types(type);
    for (unsigned i = 0; i < members; ++i) {
      if (!spvc_compiler_has_member_decoration(compiler_, resource.base_type_id, i, decoration)) {
        return false;
      }
    }
    return members > 0;
  }

  void blockCheck(const spvc_reflected_resource& resource, spvc_type block, size_t size) {
    checks_ +=
        fmt::format("#define GRISAILLE_CHECK_BLOCK_{}_{}(Struct) \\\n", name_, resource.name);
    for (unsigned i = 0; i < spvc_type_get_num_member_types(block); ++i) {
      unsigned offset = 0;
      check(context_, spvc_compiler_type_struct_member_offset(compiler_, block, i, &offset));
      const char* member = spvc_compiler_get_member_name(compiler_, resource.base_type_id, i);
      checks_ += fmt::format(
          "  static_assert(offsetof(Struct, {0}) == {1}, \"{0} is at {1}\"); \\\n", member, offset);
    }
    checks_ += fmt::format(
        "  static_assert(sizeof(Struct) >= {0}, \"the block has {0} bytes\")\n\n", size);
  }

  spvc_context context_;
  spvc_compiler compiler_;
  std::string name_;
  spvc_resources resources_ = nullptr;
  std::set<unsigned> used_;
  std::string slots_, constants_, checks_;
  unsigned constantCount_ = 0;
};

std::string wordRows(const std::vector<SpvId>& words) {
  std::string rows;
  for (size_t i = 0; i < words.size(); ++i) {
    rows += fmt::format("{:#x},{}", words[i], i % 12 == 11 ? "\n" : "");
  }
  return rows;
}

std::string literal(std::string_view text) {
  std::string rows = "    \"";
  for (const char c : text) {
    if (c == '\n') {
      rows += "\\n\"\n    \"";
    } else {
      if (c == '"' || c == '\\') rows += '\\';
      rows += c;
    }
  }
  return rows + "\"";
}

std::string table(const char* type, const char* name, const std::string& rows) {
  if (rows.empty()) return "";
  return fmt::format("static const {} {}[] = {{\n{}}};\n", type, name, rows);
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::trunc);
  file << text;
  if (!file.flush()) fail("cannot write {}", path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) fail("usage: shader_compiler FILE.spv NAME STEM");
  const std::string name = argv[2], stem = argv[3];
  const std::vector<SpvId> words = withoutSource(readWords(argv[1]));

  spvc_context context = nullptr;
  if (spvc_context_create(&context) != SPVC_SUCCESS) fail("out of memory");
  spvc_parsed_ir ir = nullptr;
  check(context, spvc_context_parse_spirv(context, words.data(), words.size(), &ir));
  spvc_compiler compiler = nullptr;
  check(context, spvc_context_create_compiler(context, SPVC_BACKEND_GLSL, ir,
                                              SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler));

  Reflection reflection(context, compiler, name);
  reflection.slots();
  reflection.constants();
  std::string inputs, outputs;
  unsigned inputCount = 0, outputCount = 0, stage = 0;
  unsigned local[3] = {0, 0, 0};
  switch (spvc_compiler_get_execution_model(compiler)) {
    case SpvExecutionModelVertex:
      inputCount = reflection.locations(SPVC_RESOURCE_TYPE_STAGE_INPUT, inputs);
      break;
    case SpvExecutionModelFragment:
      stage = 1;
      outputCount = reflection.locations(SPVC_RESOURCE_TYPE_STAGE_OUTPUT, outputs);
      break;
    case SpvExecutionModelGLCompute:
      stage = 2;
      for (unsigned i = 0; i < 3; ++i) {
        local[i] = spvc_compiler_get_execution_mode_argument_by_index(compiler,
                                                                      SpvExecutionModeLocalSize, i);
      }
      break;
    default:
      fail("{} is not a vertex, fragment or compute shader", name);
  }

  spvc_compiler_options options = nullptr;
  check(context, spvc_compiler_create_compiler_options(compiler, &options));
  spvc_compiler_options_set_uint(options, SPVC_COMPILER_OPTION_GLSL_VERSION, 450);
  spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_GLSL_ES, SPVC_FALSE);
  spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_GLSL_SUPPORT_NONZERO_BASE_INSTANCE,
                                 SPVC_FALSE);
  check(context, spvc_compiler_install_compiler_options(compiler, options));
  const char* glsl = nullptr;
  check(context, spvc_compiler_compile(compiler, &glsl));

  const std::string symbol = "grisaille_shader_" + name;
  std::string source = "/* Made by the shader compiler. */\n#include \"grisaille/shader.h\"\n\n";
  source += fmt::format("static const uint32_t spirv[] = {{\n{}\n}};\n", wordRows(words));
  source += fmt::format("static const char glsl[] =\n{};\n", literal(glsl));
  source += table("grisaille_shader_slot", "slots", reflection.slotRows());
  source += table("grisaille_shader_constant", "constants", reflection.constantRows());
  source += table("grisaille_shader_location", "inputs", inputs);
  source += table("grisaille_shader_location", "outputs", outputs);
  const auto orNull = [](unsigned count, const char* table) { return count > 0 ? table : "NULL"; };
  source += fmt::format(
      "extern const grisaille_shader {0};\nconst grisaille_shader {0} = {{\n"
      "    sizeof(grisaille_shader), {1}u, \"{2}\", spirv, {3}u, glsl,\n"
      "    {4}, {5}u, {6}, {7}u, {8}, {9}u, {10}, {11}u, {{{12}u, {13}u, {14}u}}}};\n",
      symbol, stage, name, words.size(), orNull(reflection.slotCount(), "slots"),
      reflection.slotCount(), orNull(reflection.constantCount(), "constants"),
      reflection.constantCount(), orNull(inputCount, "inputs"), inputCount,
      orNull(outputCount, "outputs"), outputCount, local[0], local[1], local[2]);
  write(stem + ".c", source);
  write(stem + ".h",
        fmt::format(
            "/* Made by the shader compiler. */\n#pragma once\n#include \"grisaille/shader.h\"\n\n"
            "#ifdef __cplusplus\nextern \"C\" {{\n#endif\nextern const grisaille_shader {};\n"
            "#ifdef __cplusplus\n}}\n#endif\n\n{}",
            symbol, reflection.blockChecks()));
  spvc_context_destroy(context);
}
