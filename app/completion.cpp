// SPDX-License-Identifier: MIT
// grisaille completion: the bash completion, made from the program's own options; the keys of
// effects are asked of the program when Tab is pressed.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "app/active_effects.h"
#include "app/command.h"

namespace grisaille::app {
namespace {

std::string optionNames(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) names += fmt::format(" {}", option->get_name());
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
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} words=""
  COMPREPLY=()
  case $previous in
    --backend) words="opengl vulkan" ;;
    --surface) words="white base" ;;
    --effects) words=$("${{COMP_WORDS[0]}}" completion --effects 2>/dev/null) ;;
    --set)
      compopt -o nospace
      words=$("${{COMP_WORDS[0]}}" completion --parameters 2>/dev/null) ;;
    --load|--save) compopt -o nospace; words="sspm=" ;;
    --write) compopt -o nospace; words="color= depth= normal= facet_normal= base_colour= ao= paint= paint_coverage= ao_error= ceiling= ceiling_error= mask=" ;;
    --camera|--config|--paint|--timings|--coverage|--write-camera) COMPREPLY=($(compgen -f -- "$current")); return ;;
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

std::string keys(bool parameters) {
  std::string text;
  const auto registry = loadEffects({});
  for (const effect::Effect& effect : registry->effects()) {
    if (!parameters) text += fmt::format("{}\n", effect.desc->key);
    for (const grisaille_param_desc& param : effect.params()) {
      if (parameters) text += fmt::format("{}.{}=\n", effect.desc->key, param.key);
    }
  }
  return text;
}

}  // namespace

void addCompletion(CLI::App& program) {
  CLI::App* command = program.add_subcommand("completion", "Print the bash completion script");
  auto effects = std::make_shared<bool>(false), parameters = std::make_shared<bool>(false);
  command->add_flag("--effects", *effects, "Print the effects' keys instead");
  command->add_flag("--parameters", *parameters, "Print the parameters' keys instead");
  command->callback([&program, effects, parameters] {
    const bool list = *effects || *parameters;
    std::fputs((list ? keys(*parameters) : script(program)).c_str(), stdout);
  });
}

}  // namespace grisaille::app
