// SPDX-License-Identifier: MIT
#include "app/verify/shader_variants.h"

#include <fmt/format.h>

#include <cctype>
#include <regex>
#include <vector>

namespace grisaille::app {
namespace {

constexpr const char* kReversedThreads = R"(
#define GRISAILLE_LOCAL (gl_WorkGroupSize - 1u - gl_LocalInvocationID)
#define GRISAILLE_INDEX \
  (gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z - 1u - gl_LocalInvocationIndex)
#define GRISAILLE_GLOBAL (gl_WorkGroupID * gl_WorkGroupSize + GRISAILLE_LOCAL)
)";

// The macros do not expand in themselves. llvmpipe leaves a loop after 65,535 turns.
constexpr const char* kCountedTurns = R"(
uint grisaille_turns = 0u;
bool grisaille_endless() { return grisaille_turns > 50000u; }
#define imageStore(i, p, v) imageStore(i, p, grisaille_endless() ? (v) - (v) : (v))
)";

constexpr const char* kWithin = R"(
int grisaille_at(int i, int n) { return i >= 0 && i < n ? i : GRISAILLE_LAST * (n - 1); }
int grisaille_at(uint i, int n) { return i < uint(n) ? int(i) : GRISAILLE_LAST * (n - 1); }
ivec2 grisaille_at(ivec2 p, ivec2 n) {
  return ivec2(grisaille_at(p.x, n.x), grisaille_at(p.y, n.y));
}
ivec3 grisaille_at(ivec3 p, ivec3 n) {
  return ivec3(grisaille_at(p.xy, n.xy), grisaille_at(p.z, n.z));
}
// A store outside of an image has no effect, or hits the texel that the thread wrote last.
ivec3 grisaille_stored = ivec3(-1);
ivec3 grisaille_store(ivec3 p, ivec3 n) {
  if (p == grisaille_at(p, n)) grisaille_stored = p;
  return GRISAILLE_LAST == 0 || p == grisaille_at(p, n) ? p : grisaille_stored;
}
ivec2 grisaille_store(ivec2 p, ivec2 n) { return grisaille_store(ivec3(p, 0), ivec3(n, 1)).xy; }
#define imageStore(i, p, v) imageStore(i, grisaille_store(p, imageSize(i)), v)
#define imageLoad(i, p) imageLoad(i, grisaille_at(p, imageSize(i)))
#define texelFetch(s, p, l) texelFetch(s, grisaille_at(p, textureSize(s, l)), l)
)";

void replaceAll(std::string& text, const std::string& what, const std::string& with) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
}

// The arrays of storage blocks, as expressions: "_41.values".
std::vector<std::string> storageArrays(const std::string& glsl) {
  static const std::regex block(R"(buffer\s+\w+\s*\{([^}]*)\}\s*(\w+)\s*;)");
  static const std::regex member(R"((\w+)\[\w*\]\s*;)");
  std::vector<std::string> arrays;
  for (std::sregex_iterator b(glsl.begin(), glsl.end(), block), end; b != end; ++b) {
    const std::string members = (*b)[1];
    for (std::sregex_iterator m(members.begin(), members.end(), member); m != end; ++m) {
      arrays.push_back((*b)[2].str() + "." + (*m)[1].str());
    }
  }
  return arrays;
}

// Wraps each index of the array: array[index] becomes array[grisaille_at(index, array.length())].
void boundIndices(std::string& glsl, const std::string& array) {
  const std::string open = array + "[", call = "grisaille_at(";
  for (size_t at = 0; (at = glsl.find(open, at)) != std::string::npos;) {
    const bool whole = at == 0 || (std::isalnum(static_cast<unsigned char>(glsl[at - 1])) == 0 &&
                                   glsl[at - 1] != '_');
    const size_t from = at + open.size();
    at = from;
    if (!whole) continue;
    size_t to = from;
    for (int depth = 1; to < glsl.size(); ++to) {
      if (glsl[to] == '[') ++depth;
      if (glsl[to] == ']' && --depth == 0) break;
    }
    glsl.insert(to, ", " + array + ".length())");
    glsl.insert(from, call);
    at = from + call.size();  // the index may hold further indices
  }
}

}  // namespace

std::string variantOf(std::string glsl, Variant variant) {
  if (variant == Variant::kPlain) return glsl;
  std::string added;
  if (variant == Variant::kReversed) {
    replaceAll(glsl, "gl_GlobalInvocationID", "GRISAILLE_GLOBAL");
    replaceAll(glsl, "gl_LocalInvocationIndex", "GRISAILLE_INDEX");
    replaceAll(glsl, "gl_LocalInvocationID", "GRISAILLE_LOCAL");
    added = kReversedThreads;
  } else if (variant == Variant::kCounted) {
    static const std::regex loop(R"((\b(for|while) \([^\n]*\)\s*\{))");
    glsl = std::regex_replace(glsl, loop, "$1 ++grisaille_turns; if (grisaille_endless()) break;");
    added = kCountedTurns;
  } else {
    for (const std::string& array : storageArrays(glsl)) boundIndices(glsl, array);
    added = fmt::format("#define GRISAILLE_LAST {}\n", variant == Variant::kLast ? 1 : 0) + kWithin;
  }
  glsl.insert(glsl.find('\n') + 1, added);  // nothing may stand before #version
  return glsl;
}

gpu::ComputePipeline VariantMaker::createComputePipeline(const gpu::ComputePipelineDesc& desc) {
  if (desc.shader == nullptr || variant_ == Variant::kPlain) {
    return ForwardingMaker::createComputePipeline(desc);
  }
  Own& own = shaders_.emplace_back(Own{variantOf(desc.shader->glsl, variant_), *desc.shader});
  own.shader.glsl = own.glsl.c_str();
  gpu::ComputePipelineDesc other = desc;
  other.shader = &own.shader;
  return ForwardingMaker::createComputePipeline(other);
}

}  // namespace grisaille::app
