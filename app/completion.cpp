// SPDX-License-Identifier: MIT
// grisaille completion: prints a bash completion script with the program's own options. When the
// user presses Tab, the script runs the program to list the keys of the effects.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "app/command.h"
#include "app/settings/load_effects.h"
#include "app/settings/presets.h"
#include "core/base/error.h"
#include "core/scene/built_in.h"

namespace grisaille::app {
namespace {

// The names of its options and, if it takes a scene, of the built-in scenes.
std::string optionNames(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) names += fmt::format(" {}", option->get_name());
  }
  if (command.get_option_no_throw("scene") != nullptr) {
    for (const scene::BuiltIn& one : scene::builtIns()) names += fmt::format(" {}", one.name);
  }
  return names;
}

std::string script(const CLI::App& program) {
  std::string commands, cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands += " " + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), optionNames(*command));
  }
  return fmt::format(R"(# bash completion for grisaille
_grisaille() {{
  [[ ${{COMP_WORDS[COMP_CWORD]}} == = ]] && COMP_WORDS+=("") && ((++COMP_CWORD))
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} words=""
  COMPREPLY=()
  case $previous in
    --backend) words="opengl vulkan" ;;
    --surface) words="white base" ;;
    --depth-kind) words="view distance clip clip-reversed" ;;
    --normal-space) words="world view" ;;
    --language) words="c++ c" ;;
    --effects) words=$("${{COMP_WORDS[0]}}" completion --effects 2>/dev/null) ;;
    --set)
      compopt -o nospace
      words=$("${{COMP_WORDS[0]}}" completion --parameters 2>/dev/null) ;;
    --preset)
      compopt -o nospace
      words=$("${{COMP_WORDS[0]}}" completion --presets 2>/dev/null) ;;
    =)  # bash splits words at '='
      [[ ${{COMP_WORDS[COMP_CWORD-3]}} == --preset ]] &&
        words=$("${{COMP_WORDS[0]}}" completion --presets 2>/dev/null |
          sed -n "s/^${{COMP_WORDS[COMP_CWORD-2]}}=//p") ;;
    --load|--add|--save)
      compopt -o nospace
      words=$("${{COMP_WORDS[0]}}" completion --objects 2>/dev/null) ;;
    --write)
      compopt -o nospace
      words="color= depth= back_depth= next_depth= thickness= motion= normal= facet_normal= base_colour= ao= ao_error= ceiling= ceiling_error="
      words+=" "$("${{COMP_WORDS[0]}}" completion --outputs 2>/dev/null) ;;
    --camera|--config|--reference|--capture|--timings|--coverage|--write-camera) COMPREPLY=($(compgen -f -- "$current")); return ;;
    --plugin-path|--out|--bookmarks) COMPREPLY=($(compgen -d -- "$current")); return ;;
  esac
  if [[ -z $words ]]; then
    case ${{COMP_WORDS[1]}} in
{}    esac
    [[ $COMP_CWORD -eq 1 ]] && words="{} --help --version"
    [[ $current != -* ]] && COMPREPLY=($(compgen -f -- "$current"))
  fi
  COMPREPLY+=($(compgen -W "$words" -- "$current"))
}}
complete -o filenames -F _grisaille grisaille
)",
                     cases, commands);
}

// One preset per line; none for an effect with a damaged presets file. `grisaille effects` reports
// the damage.
std::string presetNames(const effect::Effect& effect) {
  std::string text;
  try {
    for (const Preset& preset : loadPresets(effect).all) {
      text += fmt::format("{}={}\n", effect.desc->key, preset.name);
    }
  } catch (const Error&) {
  }
  return text;
}

std::string parameterKeys(const effect::Effect& effect) {
  std::string text;
  for (const grisaille_param_desc& param : effect.params()) {
    text += fmt::format("{}.{}=\n", effect.desc->key, param.key);
  }
  return text;
}

std::string effectKey(const effect::Effect& effect) {
  return fmt::format("{}\n", effect.desc->key);
}

std::string outputKeys(const effect::Effect& effect) {
  std::string text;
  for (const grisaille_output_desc& output : effect.outputs()) {
    text += fmt::format("{}=\n", output.key);
  }
  return text;
}

// The key of an effect that has objects, else "".
std::string objectsKey(const effect::Effect& effect) {
  return effect.objects() != nullptr ? fmt::format("{}=\n", effect.key()) : "";
}

}  // namespace

void addCompletion(CLI::App& program) {
  CLI::App* command = program.add_subcommand("completion", "Print the bash completion script");
  // The function that prints a list entry for each effect; null: print the script.
  auto list = std::make_shared<std::string (*)(const effect::Effect&)>(nullptr);
  const auto lists = [&](const char* option, auto* words, const char* help) {
    command->add_flag_callback(
        option, [list, words] { *list = words; }, help);
  };
  lists("--effects", &effectKey, "Print the keys of the effects instead of the script");
  lists("--parameters", &parameterKeys, "Print the keys of the parameters instead of the script");
  lists("--outputs", &outputKeys, "Print the outputs of the effects instead of the script");
  lists("--objects", &objectsKey,
        "Print the keys of effects that have objects instead of the script");
  lists("--presets", &presetNames, "Print the presets of the effects instead of the script");
  command->callback([&program, list] {
    if (*list == nullptr) {
      std::fputs(script(program).c_str(), stdout);
      return;
    }
    const auto registry = loadEffects({});
    for (const effect::Effect& effect : registry->effects()) {
      std::fputs((*list)(effect).c_str(), stdout);
    }
  });
}

}  // namespace grisaille::app
