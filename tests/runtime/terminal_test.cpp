// The program's output on a terminal, and its output elsewhere.
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "program.hpp"

namespace zwang {
namespace {

const std::string specs_of_terminal = std::string(ZWANG_SOURCE_DIR) + "/specs/";

class OnATerminal : public test::Program {
 protected:
  void SetUp() override {
    setenv("TERM", "xterm-256color", 1);
    unsetenv("NO_COLOR");
  }
  void TearDown() override { close(terminal_); }

  void resize(unsigned short columns) const {
    winsize size{};
    size.ws_row = 24;
    size.ws_col = columns;
    ASSERT_EQ(ioctl(terminal_, TIOCSWINSZ, &size), 0);
  }
  /// On a terminal of its own: of one that another program has left, a read ends at once.
  pid_t start_there(const std::vector<std::string>& words, unsigned short columns = 80) {
    close(terminal_);
    terminal_ = posix_openpt(O_RDWR | O_NOCTTY);
    EXPECT_EQ(grantpt(terminal_), 0);
    EXPECT_EQ(unlockpt(terminal_), 0);
    resize(columns);
    return start(words, ptsname(terminal_));
  }

  /// The output until the words have come `times` times. If they come less often: the output until its end.
  std::string read_until(const std::string& words, int times) const {
    std::string shown;
    char one = 0;
    while (times > 0 && ::read(terminal_, &one, 1) > 0) {
      shown += one;
      if (shown.ends_with(words)) --times;
    }
    return shown;
  }
  std::string read_to_the_end() const { return read_until("\n", 1 << 30); }

  /// The words of `zwang run` for a task of two steps, each so long.
  std::vector<std::string> run_of_steps(const std::string& each) {
    const std::string still =
        "{still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: "
        "0 rad/s}}}";
    const auto step = [&](const std::string& name, const std::string& next) {
      return "  " + name + ":\n    constraints: " + still + "\n    exits: [{when: elapsed > " + each +
             ", goto: " + next + "}]\n    timeout: never\n";
    };
    write("task.yaml", "zwang: 1\nrobot: none.yaml\nstart: first\ntasks:\n" + step("first", "second") +
                           step("second", "done"));
    return {"run",     (folder_ / "task.yaml").string(),
            "--robot", specs_of_terminal + "robots/mecanum_base.yaml",
            "--scene", specs_of_terminal + "scenes/open.yaml",
            "--log",   "log"};
  }

  int terminal_ = -1;
};

// A live line of a run in real time. It begins with the time and the task: more than 20 columns.
TEST_F(OnATerminal, ALineInPlaceIsCutToTheWidthAndFollowsIt) {
  std::vector<std::string> words = run_of_steps("1000 s");
  words.push_back("--watch");
  const pid_t child = start_there(words, 12);
  const std::string head = read_until("\n", 1);
  EXPECT_TRUE(head.starts_with("task.yaml: robot")) << head;
  const std::string lines = read_until("\033[K", 3);
  std::size_t count = 0;
  for (std::size_t at = lines.find('\r'); at != std::string::npos; at = lines.find('\r', at + 1)) {
    ++count;
    EXPECT_EQ(lines.find("\033[K", at), at + 10) << "12 columns, of which 3 stay free for an echoed ^C";
  }
  EXPECT_EQ(count, 3u);
  // Nine columns take two lines of five: the line begins one above.
  resize(5);
  EXPECT_TRUE(read_until("\033[J", 1).ends_with("\r\033[1A  \033[J"));
  kill(child, SIGINT);
  const std::string end = read_to_the_end();
  EXPECT_NE(end.find("\r\033[K\033["), std::string::npos)
      << "the report stands in the place of the line: " << end;
  EXPECT_EQ(finish(child).code, 1);
}

TEST_F(OnATerminal, ADumbOneAndAFileHaveALineForEachTransition) {
  const std::vector<std::string> words = run_of_steps("2.0005 s");
  const std::string of_file = zwang(words).out;
  setenv("TERM", "dumb", 1);
  const pid_t child = start_there(words);
  const std::string of_terminal = read_to_the_end();
  EXPECT_EQ(finish(child).code, 0);
  const std::string begin =
      "task.yaml: robot `mecanum_base`\n"
      "  0.000 s  - -> first  start\n"
      "  2.001 s  first -> second  elapsed > 2.0005 s\n"
      "  4.002 s  second -> done  elapsed > 2.0005 s\n"
      "\ndone after ";
  EXPECT_EQ(of_file.substr(0, begin.size()), begin);
  EXPECT_EQ(of_terminal.find('\033'), std::string::npos);
  EXPECT_NE(of_terminal.find("first -> second"), std::string::npos);
}

TEST_F(OnATerminal, ColoursAreThereWhereTheyAreTaken) {
  const std::string bad = "zwang: 1\nrobot: none.yaml\nstrat: go\n";
  write("bad.yaml", bad);
  const auto on_terminal = [&] {
    const pid_t child = start_there({"validate", "bad.yaml"});
    const std::string shown = read_to_the_end();
    EXPECT_EQ(finish(child).code, 1);
    return shown;
  };
  const auto without = [](std::string text, const std::string& piece) {
    for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos;) text.erase(at, piece.size());
    return text;
  };
  const std::string plain = zwang({"validate", "bad.yaml"}).out;
  EXPECT_EQ(plain.find('\033'), std::string::npos) << "a file has none";
  EXPECT_EQ(plain.find('\xEF'), std::string::npos) << "and no mark";
  const std::string coloured = without(on_terminal(), "\r");
  EXPECT_NE(coloured.find(": \033[1;31merror E101\033[0m: "), std::string::npos) << coloured;
  EXPECT_NE(coloured.find(" | \033[1;31m^~~~~\033[0m\n"), std::string::npos) << coloured;
  EXPECT_EQ(without(without(coloured, "\033[1;31m"), "\033[0m"), plain) << "the words are the same";
  setenv("NO_COLOR", "", 1);
  EXPECT_NE(on_terminal().find('\033'), std::string::npos) << "an empty value does not count";
  setenv("NO_COLOR", "0", 1);
  EXPECT_EQ(on_terminal().find('\033'), std::string::npos);
  unsetenv("NO_COLOR");
  setenv("TERM", "dumb", 1);
  EXPECT_EQ(on_terminal().find('\033'), std::string::npos);
}

// Of a run: the outcome and a limit that was broken. JSON has no colour on a terminal either.
TEST_F(OnATerminal, AVerdictHasItsColourAndJsonHasNone) {
  std::vector<std::string> words = run_of_steps("0.1 s");
  words.push_back("--quiet");
  pid_t child = start_there(words);
  EXPECT_NE(read_to_the_end().find("\033[1;32mdone\033[0m after "), std::string::npos);
  EXPECT_EQ(finish(child).code, 0);
  words.insert(words.end(), {"--format", "json"});
  child = start_there(words);
  EXPECT_EQ(read_to_the_end().find('\033'), std::string::npos);
  EXPECT_EQ(finish(child).code, 0);
}

}  // namespace
}  // namespace zwang
