#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> text() {
  static constexpr std::array entries{
      Explanation{
          .code = "E100",
          .title = "the text cannot be read as YAML",
          .why =
              R"~(zwang reads a careful kind of YAML: UTF-8, indented with spaces, quotes that close on their line,
one document. A tab or an invisible character is refused even where YAML would let it pass, because
two people would read the same file differently.)~",
          .fix =
              R"~(Look at the character under the mark. Indent with spaces; quote a text that starts with a special
character; close every quote and bracket. A long text goes on in the next line, indented, without
`|` or `>`.)~",
          .part = ExcerptOf::task_file,
          .example = "about: |\n  squares up\n  to a wall",
          .instead = "about: squares up\n  to a wall"},
      Explanation{
          .code = "E101",
          .title = "an unknown key",
          .why =
              R"~(zwang never ignores a word. A misspelt limit would be no limit, and you would learn of it when the
robot moves. So each key must be one that the language knows in that place.)~",
          .fix =
              R"~(Take the key that the help names. When it names none, it lists those that are known here; perhaps
the line is indented too deep or not deep enough.)~",
          .part = ExcerptOf::group,
          .example = "x: {velcity: 0.1 m/s}",
          .instead = "x: {velocity: 0.1 m/s}"},
      Explanation{
          .code = "E102",
          .title = "a key is given twice",
          .why =
              R"~(Most YAML readers keep the last of two equal keys and say nothing. One of the two lines was meant to
do something and would not.)~",
          .fix = "Keep one of them, or give the second the name that it was meant to have.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s}\ny: {velocity: 0 m/s}\ny: {velocity: [-0.1 m/s, 0.1 m/s]}",
          .instead = "x: {velocity: 0.1 m/s}\ny: {velocity: 0 m/s}"},
      Explanation{
          .code = "E103",
          .title = "a key is missing",
          .why =
              R"~(Some things have no default that could be right for everyone: in whose axes a group speaks, where a
timeout leads, which robot it is.)~",
          .fix = "Add the key that the message names.",
          .part = ExcerptOf::task,
          .example = "timeout: {after: 20 s}",
          .instead = "timeout: {after: 20 s, goto: failed}"},
      Explanation{
          .code = "E104",
          .title = "the wrong shape",
          .why =
              R"~(The key is right, but its value has another shape. It is a list in the place of a value, a value in
the place of a list, or a list of the wrong length. A range, for example, has exactly two ends.)~",
          .fix = "Bring the value into the shape that the message names.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: [-0.1 m/s, 0 m/s, 0.1 m/s]}",
          .instead = "x: {velocity: [-0.1 m/s, 0.1 m/s]}"},
      Explanation{
          .code = "E105",
          .title = "a value or a condition that cannot be read",
          .why =
              R"~(A number, a name or a condition belongs here, and the text is none, or is out of bounds. Conditions
join comparisons (`<`, `<=`, `>`, `>=`) with `and`, `or`, `not`. There is no `==`, because a
measured number never equals another one exactly.)~",
          .fix = "Write what the message asks for, at the mark.",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: elapsed > 2 s && speed(base) < 5 mm/s, for: 0.1 s, goto: done}",
          .instead = "exits:\n  - {when: elapsed > 2 s and speed(base) < 5 mm/s, for: 0.1 s, goto: done}"},
      Explanation{
          .code = "E106",
          .title = "tags, anchors and merge keys are not part of zwang",
          .why =
              R"~(YAML can give a value a type (`!!str`), name it (`&slow`), repeat it (`*slow`) and merge it (`<<`).
A reader then has to run the file in the head to know what a line says. Parameters and templates do
the same with names that the checks know.)~",
          .fix = "Use `params:` for a value that occurs twice and `templates:` with `use:` for a task that "
                 "does.",
          .part = ExcerptOf::group,
          .example = "x: &still {velocity: 0 m/s}",
          .instead = "x: {velocity: 0 m/s}"},
      Explanation{
          .code = "E107",
          .title = "a comma cut a condition or a text in two",
          .why =
              R"~(Inside `{..}` a comma ends a value. The rest is then read as a new key, and the condition or the
text would silently lose its second half.)~",
          .fix = "Quote it, or write one key a line.",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: elapsed > 2 s, elapsed < 3 s, goto: done}",
          .instead = "exits:\n  - when: elapsed > 2 s and elapsed < 3 s\n    goto: done"},
      Explanation{
          .code = "E108",
          .title = "a file of another version",
          .why =
              R"~(The first key tells which version of the language a file is written in. A newer one may use the same
words with another meaning, so it is not guessed at.)~",
          .fix = "Update zwang, or write the file in the version that this program reads.",
          .part = ExcerptOf::task_file,
          .example = "zwang: 3",
          .instead = "zwang: 2"},
      Explanation{
          .code = "E109",
          .title = "a file that cannot be read",
          .why =
              R"~(The file does not exist, is not a regular file, or lies outside the root folder. The root is the
nearest parent folder with an empty file `.zwang-root`, else the folder of the file on the command
line. Nothing is fetched from the network. A file of another author must not make zwang read yours.)~",
          .fix =
              R"~(Correct the path; it counts from the file that it is written in. If the place is right, mark the
folder above both with an empty file named `.zwang-root`.)~",
          .part = ExcerptOf::task_file,
          .example = "robot: ../../elsewhere/robot.yaml",
          .instead = "robot: robots/mini.yaml"},
      Explanation{
          .code = "E110",
          .title = "the file is too large",
          .why =
              R"~(A task, robot or scene file holds at most 256 KiB. Checking always ends within two seconds; that
takes a bound on what there is to check.)~",
          .fix = "Split it: a task file is one action, and a mission is made of several above it."},
      Explanation{.code = "E111",
                  .title = "a line is too long",
                  .why = "A line holds at most 4096 bytes. Longer ones are made by programs, or by mistake.",
                  .fix = "Break the line: lists and maps may have one entry a line."},
      Explanation{.code = "E112",
                  .title = "nested too deeply",
                  .why = "Brackets and indents may be nested 32 deep. The language needs nine.",
                  .fix = "Look for a bracket that was opened again and again and never closed."},
      Explanation{.code = "E113",
                  .title = "too many keys and values",
                  .why = "A file may hold 20 000 keys, values, lists and maps together, and its templates "
                         "may make as many "
                         "again where they are used.",
                  .fix = "Split the file, or use templates for tasks that repeat themselves."},
      Explanation{.code = "E114",
                  .title = "a key is too long",
                  .why = "A key holds at most 128 bytes: names are for people to say.",
                  .fix = "Choose a shorter name; `about`, `help` and comments hold explanations."},
      Explanation{.code = "E115",
                  .title = "a value is too long",
                  .why = "A single value holds at most 4096 bytes.",
                  .fix = "Break a long condition into several exits, a long text into comments."},
      Explanation{.code = "E116",
                  .title = "too many tasks",
                  .why = "A file may hold 256 tasks.",
                  .fix = "Split the file: what is planned or chosen above it belongs above it."},
      Explanation{
          .code = "E117",
          .title = "too many constraint groups",
          .why =
              R"~(A task, or `always`, may hold 32 groups. A base has three freedoms: most of so many rows could only
get in each other's way.)~",
          .fix = "Join groups that move the same frame in the same axes; move limits that always hold to "
                 "`always`."},
      Explanation{
          .code = "E118",
          .title = "an instruction to zwang that cannot be read",
          .why =
              R"~(A comment that starts with `# zwang:` speaks to the program. There is one instruction: `allow`, a
code and the reason. The reason is not optional: the next reader has to know why the warning does
not matter here.)~",
          .fix = "Write `# zwang: allow CODE the reason`, or take `zwang:` out of the comment.",
          .part = ExcerptOf::task,
          .example = "constraints:\n  wait:  # zwang: allow W501\n    move: base\n    in: base\n"
                     "    x: {velocity: 0 m/s}",
          .instead = "constraints:\n  wait:  # stands still for the operator\n    move: base\n    in: "
                     "base\n"
                     "    x: {velocity: 0 m/s}"},
      Explanation{
          .code = "E119",
          .title = "a code that cannot be silenced",
          .why =
              R"~(Either there is no such code, or it is an error. An error means that the file has no meaning that
could be run; silencing it would not give it one.)~",
          .fix = "Correct the code, or mend what the error is about.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s}  # zwang: allow W999 it is only a test",
          .instead = "x: {velocity: 0.1 m/s}"},
      Explanation{
          .code = "W120",
          .title = "an `allow` that silences nothing",
          .why =
              R"~(The comment allows a warning that zwang does not give on that line. Either the cause was mended, or
an edit moved the comment to another line.)~",
          .fix =
              R"~(Delete the comment, or put it on the line that the warning names. Alone on a line it speaks for the
next line that is not a comment.)~",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s}  # zwang: allow W503 the operator ends it",
          .instead = "x: {velocity: 0.1 m/s}"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
