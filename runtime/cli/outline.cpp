#include "outline.hpp"

#include <sstream>

namespace zwang::cli {

namespace {

std::string replaced(const std::string& text, char what, const std::string& by) {
  std::string result;
  for (const char c : text) result += c == what ? by : std::string(1, c);
  return result;
}

std::string option_words(const VerbOutline& verb) {
  std::string words;
  for (const OptionOutline& option : verb.options)
    for (const std::string& name : option.names) words += (words.empty() ? "" : " ") + name;
  return words;
}

std::string verb_words(const VerbOutline& program) {
  std::string words;
  for (const VerbOutline& verb : program.verbs) words += (words.empty() ? "" : " ") + verb.name;
  return words;
}

// ---------------------------------------------------------------------------------------------------- bash
std::string bash(const VerbOutline& program) {
  std::ostringstream out;
  out << "# Completion of " << program.name
      << " in bash. Files are completed where neither verb nor option is.\n_" << program.name
      << "() {\n  local word=${COMP_WORDS[COMP_CWORD]} words=''\n  COMPREPLY=()\n  if ((COMP_CWORD == 1)); "
         "then\n    words='"
      << verb_words(program) << ' ' << option_words(program) << "'\n  else\n    case ${COMP_WORDS[1]} in\n";
  for (const VerbOutline& verb : program.verbs) {
    out << "      " << verb.name << ")\n";
    if (verb.verbs.empty()) {
      out << "        if [[ $word == -* ]]; then words='" << option_words(verb) << "'; fi ;;\n";
      continue;
    }
    out << "        if ((COMP_CWORD == 2)); then words='" << verb_words(verb)
        << "'\n        elif [[ $word == -* ]]; then\n"
        << "          case ${COMP_WORDS[2]} in\n";
    for (const VerbOutline& inner : verb.verbs)
      out << "            " << inner.name << ") words='" << option_words(inner) << "' ;;\n";
    out << "          esac\n        fi ;;\n";
  }
  out << "    esac\n  fi\n  if [[ $words ]]; then mapfile -t COMPREPLY < <(compgen -W \"$words\" -- "
         "\"$word\"); fi\n}\n"
      << "complete -o bashdefault -o default -F _" << program.name << ' ' << program.name << "\n";
  return out.str();
}

// ----------------------------------------------------------------------------------------------------- zsh
/// In single quotes; brackets and colons have a meaning of their own there.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result;
}

void zsh_verbs(std::ostringstream& out, const std::string& indent, const VerbOutline& program) {
  out << indent << "local -a verbs=(\n";
  for (const VerbOutline& verb : program.verbs)
    out << indent << "  '" << verb.name << ':' << zsh_text(verb.help) << "'\n";
  out << indent << ")\n" << indent << "_describe verb verbs\n";
}

void zsh_arguments(std::ostringstream& out, const std::string& indent, const VerbOutline& verb) {
  out << indent << "_arguments";
  for (const OptionOutline& option : verb.options)
    for (const std::string& name : option.names)
      out << " \\\n"
          << indent << "  '" << name << '[' << zsh_text(option.help) << ']'
          << (option.takes_value ? ":value:_files" : "") << '\'';
  out << " \\\n" << indent << "  '*:file:_files'\n";
}

std::string zsh(const VerbOutline& program) {
  std::ostringstream out;
  out << "#compdef " << program.name << "\n# Completion of " << program.name << " in zsh.\n_" << program.name
      << "() {\n  if ((CURRENT == 2)); then\n";
  zsh_verbs(out, "    ", program);
  out << "    return\n  fi\n  local verb=${words[2]}\n  shift words\n  ((CURRENT--))\n  case $verb in\n";
  for (const VerbOutline& verb : program.verbs) {
    out << "    " << verb.name << ")\n";
    if (verb.verbs.empty()) {
      zsh_arguments(out, "      ", verb);
    } else {
      out << "      if ((CURRENT == 2)); then\n";
      zsh_verbs(out, "        ", verb);
      out << "        return\n      fi\n      verb=${words[2]}\n      shift words\n      ((CURRENT--))\n     "
             " case $verb in\n";
      for (const VerbOutline& inner : verb.verbs) {
        out << "        " << inner.name << ")\n";
        zsh_arguments(out, "          ", inner);
        out << "          ;;\n";
      }
      out << "      esac\n";
    }
    out << "      ;;\n";
  }
  out << "  esac\n}\n_" << program.name << " \"$@\"\n";
  return out.str();
}

// ---------------------------------------------------------------------------------------------------- fish
void fish_options(std::ostringstream& out, const std::string& start, const VerbOutline& verb) {
  for (const OptionOutline& option : verb.options) {
    out << start;
    for (const std::string& name : option.names)
      out << (name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1));
    out << (option.takes_value ? " -r" : "") << " -d '" << replaced(option.help, '\'', "\\'") << "'\n";
  }
}

std::string fish(const VerbOutline& program) {
  std::ostringstream out;
  const std::string start = "complete -c " + program.name;
  out << "# Completion of " << program.name << " in fish.\n";
  for (const VerbOutline& verb : program.verbs)
    out << start << " -n __fish_use_subcommand -f -a " << verb.name << " -d '"
        << replaced(verb.help, '\'', "\\'") << "'\n";
  for (const VerbOutline& verb : program.verbs) {
    const std::string seen = "__fish_seen_subcommand_from " + verb.name;
    if (verb.verbs.empty()) fish_options(out, start + " -n '" + seen + "'", verb);
    for (const VerbOutline& inner : verb.verbs) {
      out << start << " -n '" << seen << "; and not __fish_seen_subcommand_from " << verb_words(verb)
          << "' -f -a " << inner.name << " -d '" << replaced(inner.help, '\'', "\\'") << "'\n";
      fish_options(out, start + " -n '" + seen + "; and __fish_seen_subcommand_from " + inner.name + "'",
                   inner);
    }
  }
  return out.str();
}

// --------------------------------------------------------------------------------------------- manual page
/// A line that begins with a dot or a quote would be a command; hyphens are meant as such.
std::string roff(const std::string& text) {
  std::string result = replaced(replaced(text, '\\', "\\e"), '-', "\\-");
  if (!result.empty() && (result.front() == '.' || result.front() == '\'')) result = "\\&" + result;
  return result;
}

void man_verb(std::ostringstream& out, const std::string& before, const VerbOutline& verb) {
  if (!verb.verbs.empty()) {
    for (const VerbOutline& inner : verb.verbs) man_verb(out, before + verb.name + " ", inner);
    return;
  }
  out << ".SS " << roff(before + verb.name);
  for (const OptionOutline& argument : verb.arguments) out << ' ' << roff(argument.names.front());
  out << '\n' << roff(verb.help) << ".\n";
  for (const OptionOutline& argument : verb.arguments)
    out << ".TP\n.I " << roff(argument.names.front()) << '\n' << roff(argument.help) << '\n';
  for (const OptionOutline& option : verb.options) {
    out << ".TP\n.B ";
    for (std::size_t i = 0; i < option.names.size(); ++i) out << (i ? ", " : "") << roff(option.names[i]);
    out << '\n' << roff(option.help) << '\n';
  }
}

std::string man(const VerbOutline& program) {
  std::ostringstream out;
  out << ".TH ZWANG 1 \"\" \"zwang\" \"User commands\"\n.SH NAME\nzwang \\- check and run task files for "
         "robots that touch the world\n"
      << ".SH SYNOPSIS\n.B zwang\n.I verb\n.RI [ arguments ]\n.SH DESCRIPTION\n"
      << "A task file declares force, acceleration, velocity and position on the axes of a robot's frames, "
         "with units.\n"
      << "zwang checks it against the robot, and runs it on a simulated base or inside of a host's own "
         "loop.\n"
      << ".SH VERBS\n";
  for (const VerbOutline& verb : program.verbs) man_verb(out, "", verb);
  out << ".SH EXIT STATUS\n.TP\n.B 0\nThe files are good, or the task reached done.\n"
      << ".TP\n.B 1\nWhat was checked is bad, or the task did not reach done.\n"
      << ".TP\n.B 2\nThe question could not be answered: a file is missing, or an argument is wrong.\n"
      << ".SH EXAMPLES\n.nf\nzwang init first\nzwang run first/press.yaml \\-\\-report\nzwang validate "
         "wall_align\n.fi\n";
  return out.str();
}

}  // namespace

std::string render(const VerbOutline& program, OutlineForm form) {
  switch (form) {
    case OutlineForm::bash:
      return bash(program);
    case OutlineForm::zsh:
      return zsh(program);
    case OutlineForm::fish:
      return fish(program);
    case OutlineForm::man:
      break;
  }
  return man(program);
}

}  // namespace zwang::cli
