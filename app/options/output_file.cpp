// SPDX-License-Identifier: MIT
#include "app/options/output_file.h"

#include <filesystem>
#include <map>

#include "core/base/atomic_file.h"

namespace grisaille::app {

void requireDistinct(std::span<const NamedOutput> outputs) {
  std::map<std::filesystem::path, const NamedOutput*> known;
  for (const NamedOutput& output : outputs) {
    std::error_code failed;
    if (output.file.empty() || std::filesystem::is_character_file(output.file, failed)) continue;
    const auto [twin, fresh] = known.emplace(targetOf(output.file), &output);
    if (fresh) continue;
    throw Error(ErrorId::kUsage, "{} and {} name the same file; give each output a file of its own",
                twin->second->words, output.words);
  }
}

std::vector<NamedOutput> namedOutputs(std::span<const OutputFile> writes) {
  std::vector<NamedOutput> outputs;
  for (const OutputFile& write : writes) {
    outputs.push_back({fmt::format("--write {}={}", write.output, write.file), write.file});
  }
  return outputs;
}

}  // namespace grisaille::app
