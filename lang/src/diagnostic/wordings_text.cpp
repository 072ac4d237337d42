#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

namespace {

std::string kibibytes(std::size_t bytes) {
  return bytes >= 1024 * 1024 ? std::to_string(bytes / (1024 * 1024)) + " MiB"
                              : std::to_string(bytes / 1024) + " KiB";
}

/// yaml-cpp's reasons in the words of an author.
struct Reason {
  std::string_view theirs, message, help;
};
constexpr auto reasons = std::to_array<Reason>({
    {"illegal map value", "a `: ` is not expected here",
     "lines that belong together start in the same column; give every key a line of its own and a `:`, "
     "the line above too; quote text that holds a `: `"},
    {"illegal map key", "a key is not expected here", "give every key a line of its own"},
    {"illegal flow end", "this bracket closes nothing", "delete it, or close the one that is open"},
    {"illegal block entry", "a list item `- ` is not expected here",
     "put lists on the lines below their key"},
    {"end of map flow not found", "a `{` is not closed before this place",
     "close it with `}`, or part its entries with commas"},
    {"end of sequence flow not found", "a `[` is not closed before this place", "close it with `]`"},
    {"end of map not found", "this line does not fit the lines above it",
     "lines that belong together start in the same column"},
    {"no colon behind a key", "a `:` is missing behind this word", "write `key: value`"},
    {"end of sequence not found", "this line does not fit the list above it",
     "items of a list start in the same column"},
    {"unexpected character in block scalar", "a value that starts with | or > must be quoted", ""},
    {"illegal EOF in scalar", "the file ends inside a quoted text", "close the quote"},
    {"unknown token", "this cannot start a value", "quote text that starts with a special character"},
    {"unknown escape character", "this escape is not known", "use single quotes, or `\\\\` for a backslash"},
    {"alias not found after *", "a value cannot start with `*`", ""},
    {"anchor not found after &", "a value cannot start with `&`", ""},
    {"cannot start any token", "this cannot start a value", "quote it"},
});

}  // namespace

Diagnostic unreadable_file(const Span& span, const std::string& path, const std::string& reason) {
  const bool is_a_name = !std::filesystem::path(path).has_extension();
  std::string help = "paths are seen from the folder of the file that names them";
  if (is_a_name) help += "; what ships goes by its name on the command line, as `--robot kelo_base`";
  return error("E109", span, "cannot read " + in_ticks(path) + ": " + reason, span.exists() ? help : "");
}

Diagnostic not_a_path(const Span& span, const std::string& written) {
  return error("E109", span, in_ticks(written) + " is not the path of a file",
               "write a path relative to this file; URLs and package:// are not followed");
}

Diagnostic path_outside_root(const Span& span, const std::string& written) {
  return error(
      "E109", span, in_ticks(written) + " lies outside the folder that files may be read from",
      "keep it below the folder of the task file, or mark a higher folder with an empty `.zwang-root` file");
}

Diagnostic file_too_large(const Span& span, const std::string& code, std::size_t limit) {
  return error(code, span, "this file is larger than " + kibibytes(limit));
}

Diagnostic not_utf8(const Span& span, const std::string& code) {
  return error(code, span, "this is not UTF-8 text", "save the file as UTF-8");
}

Diagnostic forbidden_character(const Span& span, const std::string& code, char32_t character) {
  std::array<char, 16> name{};
  std::snprintf(name.data(), name.size(), "U+%04X", static_cast<unsigned>(character));
  return error(code, span, "the invisible character " + std::string(name.data()) + " may not stand in a file",
               "delete it");
}

Diagnostic line_too_long(const Span& span, std::size_t limit) {
  return error("E111", span, "this line is longer than " + std::to_string(limit) + " bytes");
}

Diagnostic open_quote(const Span& span) {
  return error("E100", span, "this quote does not close on its line",
               "close the quote on the line that opens it");
}

Diagnostic tab(const Span& span, bool indents) {
  return with_replacement(
      error("E100", span, indents ? "a tab indents this line" : "a tab stands in this line",
            indents ? "indent with spaces" : "write a space"),
      indents ? "  " : " ");
}

Diagnostic unreadable_yaml(const Span& span, const std::string& reason) {
  for (const Reason& known : reasons) {
    if (reason.starts_with(known.theirs) || reason.ends_with(known.theirs)) {
      return error("E100", span, std::string(known.message), std::string(known.help));
    }
  }
  return error("E100", span, "this is not readable as YAML: " + reason);
}

Diagnostic empty_file(const Span& span) {
  return error("E100", span, "there is nothing in this file");
}

Diagnostic second_document(const Span& span) {
  return error("E100", span, "text stands behind the end of the document", "a file holds one document");
}

Diagnostic block_scalar(const Span& span) {
  return error("E100", span, "a value that starts with | or > must be quoted",
               "quote it, or continue it on the next line, indented");
}

Diagnostic complex_key(const Span& span) {
  return error("E106", span, "a key is a plain word");
}

Diagnostic alias(const Span& span) {
  return error("E106", span, "YAML aliases (`*name`) are not part of zwang",
               "use `params:` for values and `templates:` for tasks");
}

Diagnostic anchor(const Span& span) {
  return error("E106", span, "YAML anchors (`&name`) are not part of zwang",
               "use `params:` for values and `templates:` for tasks");
}

Diagnostic tag(const Span& span) {
  return error("E106", span, "YAML tags (`!name`) are not part of zwang", "quote text that starts with `!`");
}

Diagnostic exclamation_for_not(const Span& span) {
  return error("E106", span, "a condition cannot begin with `!`: YAML reads it as a tag", "write `not (..)`");
}

Diagnostic merge_key(const Span& span) {
  return error("E106", span, "YAML merge keys (`<<`) are not part of zwang", "use `templates:` and `use:`");
}

Diagnostic duplicate_key(const Span& span, const std::string& key, const Span& first) {
  return error("E102", span, in_ticks(key) + " is given twice",
               "keep one of them; the first stands on line " + std::to_string(first.begin.line));
}

Diagnostic too_deep(const Span& span, int limit) {
  return error("E112", span,
               "brackets and indents are nested deeper than " + std::to_string(limit) + " levels");
}

Diagnostic too_many_nodes(const Span& span, int limit) {
  return error("E113", span, "the file has more than " + std::to_string(limit) + " keys and values");
}

Diagnostic too_many_expanded_nodes(const Span& span, int limit) {
  return error("E113", span,
               "here the templates have made more than " + std::to_string(limit) + " keys and values");
}

Diagnostic key_too_long(const Span& span, std::size_t limit) {
  return error("E114", span, "this key is longer than " + std::to_string(limit) + " bytes");
}

Diagnostic scalar_too_long(const Span& span, std::size_t limit) {
  return error("E115", span, "this value is longer than " + std::to_string(limit) + " bytes");
}

Diagnostic too_many_tasks(const Span& span, std::size_t limit) {
  return error("E116", span, "the file has more than " + std::to_string(limit) + " tasks");
}

Diagnostic too_many_groups(const Span& span, std::size_t limit) {
  return error("E117", span, "more than " + std::to_string(limit) + " constraint groups in one place");
}

Diagnostic other_version(const Span& span, const std::string& key, const std::string& version, int newest) {
  const std::string read = newest == 1 ? "1" : "1 to " + std::to_string(newest);
  return error("E108", span, "this file is " + key + " " + escaped(version) + "; this program reads " + read,
               "write `" + key + ": " + std::to_string(newest) + "`");
}

Diagnostic missing_version(const Span& span, const std::string& what, const std::string& key) {
  return error("E103", span, "this is not " + what + ": it does not say `" + key + "`",
               "start with `" + key + ": 1`");
}

Diagnostic another_kind_of_file(const Span& span, const std::string& what, const std::string& key) {
  struct Kind {
    std::string_view key, name, help_for_a_task;
  };
  constexpr auto kinds = std::to_array<Kind>({
      {"zwang_scene", "a scene file", "give the task file; this one is for its `scene`, or for `--scene`"},
      {"zwang_robot", "a robot file", "give the task file; this one is for its `robot`, or for `--robot`"},
      {"zwang_scenario", "a scenario file", "`zwang test` runs it"},
      {"zwang_connection", "a connection file",
       "give the task file; this one is for `zwang drive TASK --over`"},
      {"zwang_study", "a study", "`zwang sweep` runs it"},
  });
  std::string name = "a task file", help = "name " + what + " here";
  for (const Kind& kind : kinds) {
    if (kind.key != key) continue;
    name = kind.name;
    if (what == "a task file") help = kind.help_for_a_task;
  }
  return error("E103", span, "this is " + name + ", not " + what, help);
}

Diagnostic unknown_key(const Span& span, const std::string& key, const std::string& what,
                       const std::string& meant, const std::vector<std::string>& known,
                       const std::vector<std::string>& missing) {
  std::string help;
  for (const std::string& name : known) help += (help.empty() ? "known here: " : ", ") + name;
  std::string needed;
  for (const std::string& name : missing) needed += (needed.empty() ? "`" : ", `") + name + "`";
  if (!needed.empty()) help += "; needed, and not given: " + needed;
  return with_suggestion(error("E101", span, "unknown key " + in_ticks(key) + " in " + what, help), meant);
}

Diagnostic missing_key(const Span& span, const std::string& what, const std::string& key,
                       const std::string& value) {
  return error("E103", span, what + " does not say `" + key + "`", "add `" + key + ": " + value + "`");
}

Diagnostic expected_mapping(const Span& span, const std::string& what, bool is_list) {
  return error("E104", span, what + " must be a list of `key: value` lines",
               is_list ? "leave out the `- ` before the names" : "");
}

Diagnostic expected_vector(const Span& span, const std::string& what, std::size_t count,
                           const std::string& unit) {
  std::string example;
  for (std::size_t i = 0; i < count; ++i)
    example += (i == 0 ? "[0" : ", 0") + (unit.empty() ? unit : " " + unit);
  return error("E104", span, what + " must be a list of " + std::to_string(count) + " values",
               "for example `" + example + "]`");
}

Diagnostic expected_list(const Span& span, const std::string& what) {
  return error("E104", span, what + " must be a list", "start each item with `- `, or write `[a, b]`");
}

Diagnostic expected_word(const Span& span, const std::string& what, const std::string& word) {
  return error("E104", span, what + " must be a single word", word.empty() ? "" : "write " + in_ticks(word));
}

Diagnostic expected_value(const Span& span, const std::string& what, bool is_empty) {
  return error("E104", span, is_empty ? what + " has no value" : what + " must be a single value");
}

Diagnostic expected_integer(const Span& span, const std::string& what, int low, int high, int meant) {
  const std::string ends = std::to_string(low) + " to " + std::to_string(high);
  return error("E105", span, what + " must be a whole number from " + ends,
               "write its digits alone, for example `" + std::to_string(meant) + "`");
}

Diagnostic expected_boolean(const Span& span, const std::string& what) {
  return error("E105", span, what + " must be true or false", "write `true` or `false`");
}

Diagnostic expected_condition(const Span& span) {
  return error("E104", span, "`when` must be a condition", "for example `when: elapsed > 2 s`");
}

Diagnostic not_a_name(const Span& span, const std::string& text) {
  Diagnostic diagnostic = error("E105", span, in_ticks(text) + " cannot be a name",
                                "names are letters, digits and underscores, and start with a letter");
  std::string plain = text;
  for (char& c : plain) c = c == '-' || c == ' ' || c == '.' || c == '/' ? '_' : c;
  const auto is_of_names = [](char c) { return is_word_start(c) || (c >= '0' && c <= '9'); };
  if (plain.empty() || !is_word_start(plain.front()) || !std::ranges::all_of(plain, is_of_names))
    return diagnostic;
  diagnostic.help = "write `" + plain + "`: " + diagnostic.help;
  return with_replacement(std::move(diagnostic), plain);
}

Diagnostic reserved_name(const Span& span, const std::string& name) {
  return error("E105", span,
               "no task can be named `" + name + "`: `goto: " + name + "` has a meaning of its own");
}

Diagnostic wrong_count(const Span& span, const std::string& what, std::size_t fewest, std::size_t most,
                       std::size_t found) {
  const std::string count =
      fewest == most ? std::to_string(fewest) : std::to_string(fewest) + " to " + std::to_string(most);
  const std::string given = std::to_string(found) + (found == 1 ? " is given" : " are given");
  return error("E104", span, what + " takes " + count + " values, but " + given,
               "write as many between `[` and `]`, with commas between them");
}

Diagnostic range_ends(const Span& span, std::size_t found) {
  return error("E104", span, "a range has exactly two ends; this has " + std::to_string(found),
               "write `[low, high]`, with a comma between them");
}

Diagnostic range_where_value(const Span& span, const std::string& what, const std::string& value) {
  return with_replacement(
      error("E104", span, what + " takes a single value, not a range", "write " + in_ticks(value)), value);
}

Diagnostic value_where_range(const Span& span, const std::string& what, const std::string& text) {
  const bool is_number = parse_quantity(text).error == QuantityError::none && !text.starts_with('-');
  return error("E104", span, what + " must be a range",
               "write `[low, high]` or " + in_ticks("+-" + (is_number ? text : std::string("value"))));
}

Diagnostic bare_axis(const Span& span, const std::string& axis, const std::string& text,
                     const std::string& instead) {
  return error("E104", span, "axis `" + axis + "` does not say which quantity " + in_ticks(text) + " is",
               "write `free`, or for example `" + escaped(instead) + "`");
}

Diagnostic bare_timeout(const Span& span, const std::string& text) {
  return error("E104", span, "`timeout` must say where it leads",
               "write `timeout: {after: " + escaped(text) + ", goto: failed}`, or `timeout: never`");
}

Diagnostic bad_set(const Span& span, const std::string& key) {
  return error("E105", span, in_ticks(key) + " cannot be set",
               "write `frames.NAME: frame`, `params.NAME: value` or `outputs.NAME: value`");
}

Diagnostic yaw_and_rpy(const Span& span, const std::string& what, const Span& yaw) {
  return with_related(error("E104", span, what + " gives both `yaw` and `rpy`", "keep one of them"), yaw,
                      "`yaw` is given here");
}

Diagnostic no_tasks(const Span& span) {
  return error("E104", span, "`tasks` holds no task");
}

Diagnostic not_a_value(const Span& span, const std::string& text) {
  const bool is_bound = text.starts_with('<') || text.starts_with('>') || text.starts_with("max ") ||
                        text.starts_with("min ") || text.starts_with("up to ") ||
                        text.find("..") != std::string::npos;
  std::string help = "write a number with its unit, as `0.08 m/s`, or a parameter, as `$push`";
  if (is_bound) {
    help = "a bound is a range: write `[low, high]`, or `+-10 N`";
  } else if (text.starts_with("+/-")) {
    help = "write `+-" + escaped(trimmed(std::string_view(text).substr(3))) + "`";
  } else if (text == "inf" || text == ".inf" || text == "-.inf" || text == "infinity") {
    help = "a range has two ends: write one that the robot never comes to";
  }
  return error("E105", span, in_ticks(text) + " is not a value", help);
}

Diagnostic only_a_quantity(const Span& span, const std::string& what, const Dimension& expected) {
  const std::string unit = usual_unit(expected);
  return error("E105", span, what + " must be a plain number" + (unit.empty() ? "" : " with its unit"),
               "for example `1" + (unit.empty() ? "" : " " + unit) + "`");
}

Diagnostic number_out_of_range(const Span& span, const std::string& text) {
  return error("E105", span, in_ticks(text) + " is too large or too small a number",
               "choose a unit in which it has fewer digits");
}

Diagnostic split_condition(const Span& span) {
  return error("E107", span, "a comma cut the condition in two: inside `{..}` it starts a new key",
               "quote the condition or put it on its own line");
}

Diagnostic unreadable_instruction(const Span& span, const std::string& word) {
  return error("E118", span, "no comment can tell zwang to " + in_ticks(word),
               "write `# zwang: allow CODE the reason`");
}

Diagnostic allowance_without_code(const Span& span) {
  return error("E118", span, "this comment does not say what it allows",
               "write `# zwang: allow CODE the reason`");
}

Diagnostic allowance_without_reason(const Span& span, const std::string& code) {
  return error("E118", span, "this comment allows " + code + " without a reason",
               "write why behind the code: `# zwang: allow " + code + " the reason`");
}

Diagnostic unknown_code(const Span& span, const std::string& code, const std::string& meant) {
  return with_suggestion(
      error("E119", span, "there is no code " + in_ticks(code), "`zwang explain --all` lists the codes"),
      meant);
}

Diagnostic allowed_error(const Span& span, const std::string& code) {
  return error("E119", span, code + " is an error: it cannot be silenced", "mend what it is about");
}

Diagnostic idle_allowance(const Span& span, const std::string& code, int line) {
  return warning("W120", span, "there is no " + code + " on line " + std::to_string(line) + " to allow",
                 "delete the comment, or put it on the line that it is meant for");
}

}  // namespace zwang::lang::wording
