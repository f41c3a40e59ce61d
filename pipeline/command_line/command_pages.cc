#include "pipeline/command_line/command_pages.h"

#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

/// Commands that the help lists.
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// "-o", "--output" of an option; nothing of a place on the line.
std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  return flags;
}

/// The words that an option takes, where it takes only some ("TEXT:{bemio,wamit}"): each in quotes
/// of a shell.
std::string words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  std::string words;
  bool inside = false;
  for (const char c : type) {
    if (c == '}') inside = false;
    if (inside) words.append(c == ',' ? std::string_view("' '") : std::string_view(&c, 1));
    if (c == '{') inside = true;
  }
  return words.empty() ? words : fmt::format("'{}'", words);
}

/// A text in which man reads no macro and no hyphenation.
std::string man_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || c == '-') result += '\\';
    result += c;
  }
  return result;
}

std::string man_option(const CLI::Option& option) {
  std::string head;
  for (const std::string& flag : flags_of(option))
    head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", man_text(flag));
  if (head.empty()) head = fmt::format("\\fI{}\\fR", man_text(option.get_name(true)));
  const bool takes_value = option.get_expected_max() > 0 && !option.get_positional();
  if (takes_value && option.get_items_expected_max() > 0) head += " \\fIVALUE\\fR";
  return fmt::format(".TP\n{}\n{}\n", head, man_text(option.get_description()));
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    std::string flags, values;
    for (const CLI::Option* option : command->get_options()) {
      std::string pattern;
      for (const std::string& flag : flags_of(*option)) {
        flags += (flags.empty() ? "" : " ") + flag;
        pattern += (pattern.empty() ? "" : "|") + flag;
      }
      const std::string words = words_of(*option);
      if (words.empty() || pattern.empty()) continue;
      values += fmt::format(
          "        {}) local IFS=$'\\n'; COMPREPLY=($(compgen -W \"$(printf '%s\\n' {})\" -- "
          "\"$word\")); "
          "return ;;\n",
          pattern, words);
    }
    cases += fmt::format("    {})\n", command->get_name());
    if (!values.empty()) cases += "      case \"$before\" in\n" + values + "      esac\n";
    cases += fmt::format("      flags=\"{}\" ;;\n", flags);
  }
  return fmt::format(R"(# bash completion for blocklift
_blocklift() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} flags=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{}  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$flags" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _blocklift blocklift
)",
                     names, cases);
}

std::string manual_page(const CLI::App& app, const std::string& version) {
  std::string page = fmt::format(
      ".TH BLOCKLIFT 1 \"\" \"{0}\" \"User commands\"\n"
      ".SH NAME\nblocklift \\- {1}\n"
      ".SH SYNOPSIS\n.B blocklift\n.I command\n[options]\n.SH COMMANDS\n",
      man_text(version), man_text(app.get_description()));
  for (const CLI::App* command : commands_of(app)) {
    page += fmt::format(".SS {}\n{}\n", command->get_name(), man_text(command->get_description()));
    for (const CLI::Option* option : command->get_options()) page += man_option(*option);
  }
  page +=
      ".SH EXIT STATUS\n"
      ".TP\n0\ndone\n.TP\n1\na run failed\n.TP\n2\nthe input is wrong\n"
      ".TP\n3\ndone, and a check fails\n";
  return page;
}

}  // namespace blocklift::pipeline
